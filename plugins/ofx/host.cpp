#include "host.h"

#include <atomic>

namespace petzval::plugin {
namespace {

std::atomic<const ofx::Host*> the_host = nullptr;
Suites the_suites;

template <typename Suite>
bool fetch(const Suite*& suite, const char* name, int version) {
    suite = nullptr;
    const ofx::Host* host = the_host;
    if (host && host->fetch_suite)
        suite = static_cast<const Suite*>(host->fetch_suite(host->properties, name, version));
    return suite != nullptr;
}

}  // namespace

const Suites& suites() { return the_suites; }

void set_host(const ofx::Host* host) { the_host = host; }

bool fetch_suites() {
    Suites& s = the_suites;
    fetch(s.draw, ofx::kDrawSuite, 1);
    fetch(s.interact, ofx::kInteractSuite, 1);
    s.persistent_messages = fetch(s.message, ofx::kMessageSuite, 2);
    if (!s.persistent_messages) fetch(s.message, ofx::kMessageSuite, 1);
    const bool property = fetch(s.property, ofx::kPropertySuite, 1);
    const bool effect = fetch(s.effect, ofx::kImageEffectSuite, 1);
    return fetch(s.parameter, ofx::kParameterSuite, 1) && property && effect;
}

std::string host_name() {
    const ofx::Host* host = the_host;
    return host ? Properties(host->properties).text(ofx::kName) : "";
}

int Properties::integer(const char* name, int fallback, int index) const {
    int value = fallback;
    if (!set_ || the_suites.property->get_int(set_, name, index, &value) != ofx::kOk) return fallback;
    return value;
}

double Properties::number(const char* name, double fallback, int index) const {
    double value = fallback;
    if (!set_ || the_suites.property->get_double(set_, name, index, &value) != ofx::kOk) return fallback;
    return value;
}

void* Properties::pointer(const char* name) const {
    void* value = nullptr;
    if (!set_ || the_suites.property->get_pointer(set_, name, 0, &value) != ofx::kOk) return nullptr;
    return value;
}

std::string Properties::text(const char* name) const {
    char* value = nullptr;
    if (!set_ || the_suites.property->get_string(set_, name, 0, &value) != ofx::kOk || !value) return "";
    return value;
}

ofx::Point Properties::point(const char* name, ofx::Point fallback) const {
    return {number(name, fallback.x, 0), number(name, fallback.y, 1)};
}

bool Properties::rect(const char* name, ofx::RectI& rect) const {
    int found[4] = {};
    if (!set_ || the_suites.property->get_ints(set_, name, 4, found) != ofx::kOk) return false;
    rect = {found[0], found[1], found[2], found[3]};
    return true;
}

Properties& Properties::set(const char* name, int value, int index) {
    if (set_) the_suites.property->set_int(set_, name, index, value);
    return *this;
}

Properties& Properties::set(const char* name, double value, int index) {
    if (set_) the_suites.property->set_double(set_, name, index, value);
    return *this;
}

Properties& Properties::set(const char* name, const char* value, int index) {
    if (set_) the_suites.property->set_string(set_, name, index, value);
    return *this;
}

Properties& Properties::set(const char* name, void* value) {
    if (set_) the_suites.property->set_pointer(set_, name, 0, value);
    return *this;
}

Properties& Properties::set(const char* name, const ofx::Rect& rect) {
    const double values[4] = {rect.x1, rect.y1, rect.x2, rect.y2};
    if (set_) the_suites.property->set_doubles(set_, name, 4, values);
    return *this;
}

Properties properties_of(ofx::Effect* effect) {
    ofx::PropertySet* set = nullptr;
    if (!effect || the_suites.effect->property_set(effect, &set) != ofx::kOk) set = nullptr;
    return Properties(set);
}

void show_error(ofx::Effect* effect, const std::string& sentence) {
    const ofx::MessageSuite* messages = the_suites.message;
    if (!messages || !effect) return;
    const auto show = the_suites.persistent_messages ? messages->set_persistent : messages->message;
    if (show) show(effect, ofx::kMessageError, "", "%s", sentence.c_str());
}

// Without persistent messages it would open a window for each frame.
void show_warning(ofx::Effect* effect, const std::string& sentence) {
    const ofx::MessageSuite* messages = the_suites.message;
    if (the_suites.persistent_messages && effect && messages->set_persistent)
        messages->set_persistent(effect, ofx::kMessageWarning, "", "%s", sentence.c_str());
}

void clear_message(ofx::Effect* effect) {
    const ofx::MessageSuite* messages = the_suites.message;
    if (the_suites.persistent_messages && effect && messages->clear_persistent)
        messages->clear_persistent(effect);
}

}  // namespace petzval::plugin
