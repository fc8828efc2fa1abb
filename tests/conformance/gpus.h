// Devices that are no CPU, and how near what they draw is.
#pragma once

#include "petzval/devices.h"
#include "petzval/session.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace petzval::conformance {

inline std::vector<std::string> gpus() {
    std::vector<std::string> names;
    for (const DeviceFacts& device : devices())
        if (device.name != "cpu" && device.lacks.empty()) names.push_back(device.name);
    return names;
}

// A hardware driver stays loaded as it was first asked for: without a layer that a test wants.
inline bool drivers_stay() {
    for (const DeviceFacts& device : devices())
        if (device.name != "cpu" && !device.is_software) return true;
    return false;
}

inline Session session_on(const std::string& device) {
    SessionSettings settings;
    settings.device = device;
    return Session(settings);
}

// PSNR over all channels, relative to the peak of the brighter picture.
inline double psnr(const Picture& a, const Picture& b) {
    double peak = 0, squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Rgba d = a.pixels()[i] - b.pixels()[i], p = a.pixels()[i];
        for (const float v : {d.r, d.g, d.b, d.a}) squares += double(v) * double(v);
        for (const float v : {p.r, p.g, p.b, p.a}) peak = std::max(peak, double(std::abs(v)));
    }
    return squares == 0 ? 1e3 : 10 * std::log10(peak * peak * 4 * double(a.size()) / squares);
}

// Codes of a display.
struct CodesApart {
    int most = 0;
    double share = 0;  // of codes that differ
};
inline CodesApart codes_apart(const std::vector<std::uint16_t>& a, const std::vector<std::uint16_t>& b) {
    if (a.size() != b.size()) return {1 << 16, 1};
    CodesApart apart;
    for (std::size_t i = 0; i < a.size(); ++i) {
        apart.most = std::max(apart.most, std::abs(int(a[i]) - int(b[i])));
        apart.share += a[i] != b[i] ? 1 / double(a.size()) : 0;
    }
    return apart;
}

}  // namespace petzval::conformance
