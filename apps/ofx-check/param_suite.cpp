#include "effect.h"
#include "rules.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstring>
#include <string_view>

namespace ofx_check {
namespace {

// Parameter types: how many numbers each has, and of which kind.
struct TypeRow {
    const char* name;
    char kind;  // i, d, s; 0: no value
    int count;
};
constexpr std::array kTypes{
    TypeRow{"OfxParamTypeInteger", 'i', 1},    TypeRow{"OfxParamTypeDouble", 'd', 1},
    TypeRow{"OfxParamTypeBoolean", 'i', 1},    TypeRow{"OfxParamTypeChoice", 'i', 1},
    TypeRow{"OfxParamTypeStrChoice", 's', 1},  TypeRow{"OfxParamTypeRGBA", 'd', 4},
    TypeRow{"OfxParamTypeRGB", 'd', 3},        TypeRow{"OfxParamTypeDouble2D", 'd', 2},
    TypeRow{"OfxParamTypeInteger2D", 'i', 2},  TypeRow{"OfxParamTypeDouble3D", 'd', 3},
    TypeRow{"OfxParamTypeInteger3D", 'i', 3},  TypeRow{"OfxParamTypeString", 's', 1},
    TypeRow{"OfxParamTypeCustom", 's', 1},     TypeRow{"OfxParamTypeGroup", 0, 0},
    TypeRow{"OfxParamTypePage", 0, 0},         TypeRow{"OfxParamTypePushButton", 0, 0},
    TypeRow{"OfxParamTypeParametric", 'd', 1}, TypeRow{"OfxParamTypeBytes", 'p', 1},
};

const TypeRow* row_of(std::string_view type) {
    const auto* row =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const TypeRow& r) { return r.name == type; });
    return row == kTypes.end() ? nullptr : row;
}

// Parameters are read and written by several threads.
std::mutex mutex;

int define(ofx::ParamSet* params, const char* type, const char* name, ofx::PropertySet** set) {
    if (!params || !type || !name) return ofx::kBadHandle;
    held("params.once");
    const std::string_view action = action_now ? action_now : "";
    if (action != ofx::action::kDescribeInContext)
        broken("params.once", std::string("'") + name + "' is defined by " + std::string(action));
    const TypeRow* row = row_of(type);
    if (!row) {
        broken("params.once", std::string("'") + name + "' is of the type '" + type + "'");
        return ofx::kUnknown;
    }
    if (params->find(name)) {
        broken("params.once", std::string("'") + name + "' is defined twice");
        return ofx::kExists;
    }
    auto param = std::make_unique<ofx::Param>();
    param->name = name;
    param->type = type;
    param->properties.label = name;
    param->properties.param_type = row->kind;
    param->properties.with(ofx::kName, std::vector<std::string>{name});
    param->properties.with("OfxParamPropType", std::vector<std::string>{type});
    if (set) *set = &param->properties;
    params->params.push_back(std::move(param));
    return ofx::kOk;
}

int get_handle(ofx::ParamSet* params, const char* name, ofx::Param** param, ofx::PropertySet** set) {
    if (!params || !name) return ofx::kBadHandle;
    held("params.declared");
    ofx::Param* found = params->find(name);
    if (!found) {
        broken("params.declared", std::string("'") + name + "' was never defined");
        return ofx::kUnknown;
    }
    if (param) *param = found;
    if (set) *set = &found->properties;
    return ofx::kOk;
}

int set_properties(ofx::ParamSet* params, ofx::PropertySet** set) {
    if (!params || !set) return ofx::kBadHandle;
    *set = &params->properties;
    return ofx::kOk;
}

int param_properties(ofx::Param* param, ofx::PropertySet** set) {
    if (!param || !set) return ofx::kBadHandle;
    *set = &param->properties;
    return ofx::kOk;
}

int read(ofx::Param* param, va_list to) {
    const TypeRow* row = param ? row_of(param->type) : nullptr;
    if (!row) return ofx::kBadHandle;
    const std::lock_guard lock(mutex);
    if (row->kind == 's') *va_arg(to, const char**) = param->text.c_str();
    for (int i = 0; i < row->count; ++i) {
        if (row->kind == 'd') *va_arg(to, double*) = param->numbers[std::size_t(i)];
        if (row->kind == 'i') *va_arg(to, int*) = int(param->numbers[std::size_t(i)]);
    }
    return row->kind ? ofx::kOk : ofx::kUnsupported;
}

int write(ofx::Param* param, va_list from) {
    const TypeRow* row = param ? row_of(param->type) : nullptr;
    if (!row) return ofx::kBadHandle;
    held("params.write_action");
    const std::string_view action = action_now ? action_now : "";
    for (const char* of_frames :
         {ofx::action::kRender, ofx::action::kIsIdentity, ofx::action::kRegionOfDefinition,
          ofx::action::kRegionsOfInterest, ofx::action::kBeginSequence})
        if (action == of_frames)
            broken("params.write_action", "'" + param->name + "' is set by " + of_frames);
    const std::lock_guard lock(mutex);
    if (row->kind == 's') param->text = va_arg(from, const char*);
    for (int i = 0; i < row->count; ++i) {
        if (row->kind == 'd') param->numbers[std::size_t(i)] = va_arg(from, double);
        if (row->kind == 'i') param->numbers[std::size_t(i)] = va_arg(from, int);
    }
    return row->kind ? ofx::kOk : ofx::kUnsupported;
}

int value(ofx::Param* param, ...) {
    va_list to;
    va_start(to, param);
    const int status = read(param, to);
    va_end(to);
    return status;
}

int value_at_time(ofx::Param* param, ofx::Time time, ...) {
    va_list to;
    va_start(to, time);
    const int status = read(param, to);
    va_end(to);
    return status;
}

int set_value(ofx::Param* param, ...) {
    va_list from;
    va_start(from, param);
    const int status = write(param, from);
    va_end(from);
    return status;
}

int set_value_at_time(ofx::Param* param, ofx::Time time, ...) {
    va_list from;
    va_start(from, time);
    const int status = write(param, from);
    va_end(from);
    return status;
}

// Nothing is animated here.
int derivative(ofx::Param*, ofx::Time, ...) { return ofx::kUnsupported; }
int integral(ofx::Param*, ofx::Time, ofx::Time, ...) { return ofx::kUnsupported; }
int key_count(ofx::Param* param, unsigned int* count) {
    if (!param || !count) return ofx::kBadHandle;
    *count = 0;
    return ofx::kOk;
}
int key_time(ofx::Param*, unsigned int, ofx::Time*) { return ofx::kBadIndex; }
int key_index(ofx::Param*, ofx::Time, int, int*) { return ofx::kFailed; }
int delete_key(ofx::Param*, ofx::Time) { return ofx::kBadIndex; }
int delete_all_keys(ofx::Param* param) { return param ? ofx::kOk : ofx::kBadHandle; }
int copy(ofx::Param* to, ofx::Param* from, ofx::Time, const ofx::Range*) {
    if (!to || !from) return ofx::kBadHandle;
    to->numbers = from->numbers;
    to->text = from->text;
    return ofx::kOk;
}
int edit_begin(ofx::ParamSet* params, const char*) { return params ? ofx::kOk : ofx::kBadHandle; }
int edit_end(ofx::ParamSet* params) { return params ? ofx::kOk : ofx::kBadHandle; }

}  // namespace

const ofx::ParameterSuite& parameter_suite() {
    static const ofx::ParameterSuite suite{
        define,          get_handle, set_properties,    param_properties, value,    value_at_time, derivative,
        integral,        set_value,  set_value_at_time, key_count,        key_time, key_index,     delete_key,
        delete_all_keys, copy,       edit_begin,        edit_end};
    return suite;
}

}  // namespace ofx_check

ofx::Param* ofx::ParamSet::find(const std::string& name) const {
    for (const auto& param : params)
        if (param->name == name) return param.get();
    return nullptr;
}
