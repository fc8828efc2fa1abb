#include "files/layout.h"

#include "files/wording.h"

#include <algorithm>

namespace petzval {

const Channel* Part::find(const std::string& channel_name) const {
    for (const Channel& c : channels)
        if (c.name == channel_name) return &c;
    return nullptr;
}

bool same_pixels(const Layout& a, const Layout& b) {
    return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(),
                      [](const Part& p, const Part& q) {
                          return p.type == q.type && p.data_window == q.data_window &&
                                 p.channels == q.channels && p.complete == q.complete;
                      });
}

Channel split_channel_name(const std::string& name, const std::vector<std::string>& views) {
    Channel channel;
    channel.name = name;
    const std::size_t dot = name.rfind('.');
    channel.base = dot == std::string::npos ? name : name.substr(dot + 1);
    channel.layer = dot == std::string::npos ? "" : name.substr(0, dot);
    if (channel.layer.empty()) {
        if (!views.empty()) channel.view = views.front();
        return channel;
    }
    const std::size_t before = channel.layer.rfind('.');
    const std::string last = before == std::string::npos ? channel.layer : channel.layer.substr(before + 1);
    if (std::find(views.begin(), views.end(), last) != views.end()) {
        channel.view = last;
        channel.layer.resize(before == std::string::npos ? 0 : before);
    }
    return channel;
}

std::string without_view(const std::string& part_name, const std::string& view) {
    if (view.empty() || part_name.size() <= view.size()) return part_name;
    const std::string name = lower(part_name), key = lower(view);
    const auto separates = [](char c) { return c == '_' || c == '.' || c == '-' || c == ' '; };
    const std::size_t rest = name.size() - key.size();
    if (name.ends_with(key) && separates(name[rest - 1])) return part_name.substr(0, rest - 1);
    if (name.starts_with(key) && separates(name[key.size()])) return part_name.substr(key.size() + 1);
    return part_name;
}

}  // namespace petzval
