#include "property_set.h"

#include "rules.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <set>
#include <sstream>
#include <utility>

namespace ofx_check {
namespace {

constexpr PropertyRow kRows[] = {
#include "properties_table.inc"
};

// Words of a list separated by `mark`.
bool lists(std::string_view list, std::string_view word, char mark) {
    while (!list.empty()) {
        const auto end = std::min(list.find(mark), list.size());
        if (list.substr(0, end) == word) return true;
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return false;
}

std::mutex mutex;
std::set<const ofx::PropertySet*>& alive() {
    static std::set<const ofx::PropertySet*> sets;
    return sets;
}

template <typename T>
constexpr char kTypeOf = 0;
template <>
constexpr char kTypeOf<int> = 'i';
template <>
constexpr char kTypeOf<double> = 'd';
template <>
constexpr char kTypeOf<std::string> = 's';
template <>
constexpr char kTypeOf<void*> = 'p';

std::string named(const ofx::PropertySet& set, const char* name) {
    return std::string(name) + " of " + set.object + (set.label.empty() ? "" : " " + set.label);
}

char type_in(const ofx::PropertySet& set, const PropertyRow& row) {
    return row.type == 'm' ? set.param_type : row.type;
}

// Null, with the finding, for handles that are none.
ofx::PropertySet* checked(ofx::PropertySet* set, const char* name) {
    held("handles.valid");
    if (set && name && ofx::PropertySet::is_alive(set)) return set;
    broken("handles.valid", std::string("a property set that is ") + (set ? "no longer valid" : "null") +
                                ", asked for " + (name ? name : "a null name"));
    return nullptr;
}

template <typename T>
bool type_fits(const ofx::PropertySet& set, const char* name, const PropertyRow* row) {
    held("property.type");
    const char type = row ? type_in(set, *row) : 0;
    if (!type || type == kTypeOf<T>) return true;
    broken("property.type", named(set, name) + " is of type " + type + ", used as " + kTypeOf<T>);
    return false;
}

template <typename T>
void check_value(const ofx::PropertySet& set, const char* name, const PropertyRow* row, const T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
        if (!row || !*row->values) return;
        held("property.value");
        if (!lists(row->values, value, ' '))
            broken("property.value", named(set, name) + " is set to '" + value + "'");
    }
}

// The slot to be written, made where the specification has one and the plug-in may write it.
template <typename T>
ofx::PropertySet::Slot* slot_to_write(ofx::PropertySet& set, const char* name, const PropertyRow* row,
                                      int& status) {
    status = ofx::kUnknown;
    const auto there = set.slots.find(name);
    if (row && !has(*row, set.object) && there == set.slots.end()) {
        broken("property.object", named(set, name) + ", which has no such property");
        return nullptr;
    }
    held("property.object"), held("property.write");
    const bool own = std::string_view(name) == ofx::kInstanceData;
    if (!set.plugin_writes && !own && (row || there != set.slots.end())) {
        broken("property.write", named(set, name) + " is the host's to write");
        return nullptr;
    }
    if (there != set.slots.end()) return &there->second;
    if (!row && !own) return nullptr;  // a property of some other host
    return &set.slots.emplace(name, std::vector<T>()).first->second;
}

template <typename T>
int write(ofx::PropertySet* handle, const char* name, int index, T value) {
    ofx::PropertySet* set = checked(handle, name);
    if (!set) return ofx::kBadHandle;
    const PropertyRow* row = property_row(name);
    if (!type_fits<T>(*set, name, row)) return ofx::kBadValue;
    int status = ofx::kOk;
    ofx::PropertySet::Slot* slot = slot_to_write<T>(*set, name, row, status);
    if (!slot) return status;
    auto* values = std::get_if<std::vector<T>>(slot);
    if (!values) return ofx::kBadValue;
    held("property.index");
    const int most = row && row->dimension > 0 ? row->dimension : 1 << 16;
    if (index < 0 || index >= most) {
        broken("property.index", named(*set, name) + " at index " + std::to_string(index));
        return ofx::kBadIndex;
    }
    check_value(*set, name, row, value);
    if (values->size() <= std::size_t(index)) values->resize(std::size_t(index) + 1);
    (*values)[std::size_t(index)] = std::move(value);
    return ofx::kOk;
}

template <typename T>
const std::vector<T>* slot_to_read(ofx::PropertySet* handle, const char* name, int& status) {
    ofx::PropertySet* set = checked(handle, name);
    status = set ? ofx::kUnknown : ofx::kBadHandle;
    if (!set || property_lies.know_nothing) return nullptr;
    const PropertyRow* row = property_row(name);
    if (!type_fits<T>(*set, name, row)) return nullptr;
    const auto there = set->slots.find(name);
    return there == set->slots.end() ? nullptr : std::get_if<std::vector<T>>(&there->second);
}

template <typename T, typename Out>
int read(ofx::PropertySet* handle, const char* name, int index, Out* value) {
    int status = ofx::kOk;
    const auto* values = slot_to_read<T>(handle, name, status);
    if (!values) return status;
    held("property.index");
    const PropertyRow* row = property_row(name);
    if (index < 0 || std::size_t(index) >= values->size()) {
        if (index < 0 || (row && row->dimension > 0 && index >= row->dimension))
            broken("property.index", named(*handle, name) + " read at index " + std::to_string(index));
        return ofx::kBadIndex;
    }
    if constexpr (std::is_same_v<T, std::string>)
        *value = const_cast<char*>((*values)[std::size_t(index)].c_str());
    else
        *value = (*values)[std::size_t(index)];
    return ofx::kOk;
}

template <typename T, typename In>
int write_all(ofx::PropertySet* set, const char* name, int count, const In* values) {
    int status = ofx::kOk;
    for (int i = 0; i < count && status == ofx::kOk; ++i) status = write<T>(set, name, i, T(values[i]));
    return status;
}

template <typename T, typename Out>
int read_all(ofx::PropertySet* set, const char* name, int count, Out* values) {
    int status = ofx::kOk;
    for (int i = 0; i < count && status == ofx::kOk; ++i) status = read<T>(set, name, i, values + i);
    return status;
}

int reset(ofx::PropertySet* set, const char* name) {
    if (!checked(set, name)) return ofx::kBadHandle;
    return set->slots.contains(name) ? ofx::kOk : ofx::kUnknown;
}

int dimension(ofx::PropertySet* set, const char* name, int* count) {
    if (!checked(set, name)) return ofx::kBadHandle;
    const auto there = set->slots.find(name);
    if (there == set->slots.end() || property_lies.know_nothing) return ofx::kUnknown;
    *count = int(std::visit([](const auto& values) { return values.size(); }, there->second));
    return ofx::kOk;
}

template <typename T>
const std::vector<T>* values_of(const ofx::PropertySet& set, const char* name) {
    const auto there = set.slots.find(name);
    return there == set.slots.end() ? nullptr : std::get_if<std::vector<T>>(&there->second);
}

}  // namespace

PropertyLies property_lies;

const PropertyRow* property_row(std::string_view name) {
    const auto* row = std::lower_bound(
        std::begin(kRows), std::end(kRows), name,
        [](const PropertyRow& r, std::string_view n) { return std::string_view(r.name) < n; });
    return row != std::end(kRows) && row->name == name ? row : nullptr;
}

bool has(const PropertyRow& row, std::string_view object) { return lists(row.objects, object, ','); }

const ofx::PropertySuite& property_suite() {
    static const ofx::PropertySuite suite{
        write<void*>,
        [](ofx::PropertySet* s, const char* n, int i, const char* v) {
            return write<std::string>(s, n, i, v ? v : "");
        },
        write<double>,
        write<int>,
        write_all<void*, void*>,
        write_all<std::string, const char*>,
        write_all<double, double>,
        write_all<int, int>,
        read<void*, void*>,
        read<std::string, char*>,
        read<double, double>,
        read<int, int>,
        read_all<void*, void*>,
        read_all<std::string, char*>,
        read_all<double, double>,
        read_all<int, int>,
        reset,
        dimension,
    };
    return suite;
}

}  // namespace ofx_check

using ofx_check::values_of;

ofx::PropertySet::PropertySet(const char* object_, bool plugin_writes_)
    : object(object_), plugin_writes(plugin_writes_) {
    const std::lock_guard lock(ofx_check::mutex);
    ofx_check::alive().insert(this);
}

ofx::PropertySet::~PropertySet() {
    const std::lock_guard lock(ofx_check::mutex);
    ofx_check::alive().erase(this);
}

bool ofx::PropertySet::is_alive(const PropertySet* set) {
    const std::lock_guard lock(ofx_check::mutex);
    return ofx_check::alive().contains(set);
}

ofx::PropertySet& ofx::PropertySet::with(const char* name, std::vector<int> values) {
    slots.insert_or_assign(name, std::move(values));
    return *this;
}
ofx::PropertySet& ofx::PropertySet::with(const char* name, std::vector<double> values) {
    slots.insert_or_assign(name, std::move(values));
    return *this;
}
ofx::PropertySet& ofx::PropertySet::with(const char* name, std::vector<std::string> values) {
    slots.insert_or_assign(name, std::move(values));
    return *this;
}
ofx::PropertySet& ofx::PropertySet::with(const char* name, void* value) {
    slots.insert_or_assign(name, std::vector<void*>{value});
    return *this;
}

int ofx::PropertySet::integer(const char* name, int fallback, std::size_t index) const {
    const auto* values = values_of<int>(*this, name);
    return values && index < values->size() ? (*values)[index] : fallback;
}

double ofx::PropertySet::number(const char* name, double fallback, std::size_t index) const {
    const auto* values = values_of<double>(*this, name);
    return values && index < values->size() ? (*values)[index] : fallback;
}

std::string ofx::PropertySet::text(const char* name, std::size_t index) const {
    const auto* values = values_of<std::string>(*this, name);
    return values && index < values->size() ? (*values)[index] : "";
}

void* ofx::PropertySet::pointer(const char* name) const {
    const auto* values = values_of<void*>(*this, name);
    return values && !values->empty() ? (*values)[0] : nullptr;
}

std::vector<std::string> ofx::PropertySet::texts(const char* name) const {
    const auto* values = values_of<std::string>(*this, name);
    return values ? *values : std::vector<std::string>();
}

std::vector<double> ofx::PropertySet::numbers(const char* name) const {
    const auto* values = values_of<double>(*this, name);
    return values ? *values : std::vector<double>();
}
