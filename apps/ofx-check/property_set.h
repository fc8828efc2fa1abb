// Sets of properties as a host keeps them, which know what the specification says of each.
#pragma once

#include "ofx.h"
#include "ofx_names.h"

#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ofx_check {

// A row of the specification's table.
struct PropertyRow {
    const char* name;
    char type;  // i, d, s, p; m: that of the parameter
    int dimension;
    const char* objects;
    const char* values;
};
const PropertyRow* property_row(std::string_view name);
bool has(const PropertyRow& row, std::string_view object);

const ofx::PropertySuite& property_suite();

// Lies of a host, for one check.
struct PropertyLies {
    bool know_nothing = false;  // every getter fails
};
extern PropertyLies property_lies;

}  // namespace ofx_check

// The host's side of the handle.
struct ofx::PropertySet {
    using Slot =
        std::variant<std::vector<int>, std::vector<double>, std::vector<std::string>, std::vector<void*>>;

    explicit PropertySet(const char* object_, bool plugin_writes_ = false);
    ~PropertySet();
    PropertySet(const PropertySet&) = delete;
    PropertySet& operator=(const PropertySet&) = delete;

    const char* object;  // as in the table
    bool plugin_writes;  // others than the ones a host adds may be set
    std::string label;   // for messages
    char param_type = 0;
    std::map<std::string, Slot, std::less<>> slots;

    PropertySet& with(const char* name, std::vector<int> values);
    PropertySet& with(const char* name, std::vector<double> values);
    PropertySet& with(const char* name, std::vector<std::string> values);
    PropertySet& with(const char* name, void* value);

    int integer(const char* name, int fallback = 0, std::size_t index = 0) const;
    double number(const char* name, double fallback = 0, std::size_t index = 0) const;
    std::string text(const char* name, std::size_t index = 0) const;
    void* pointer(const char* name) const;
    std::vector<std::string> texts(const char* name) const;
    std::vector<double> numbers(const char* name) const;

    // True for sets that the host has made and not ended.
    static bool is_alive(const PropertySet* set);
};
