#!/bin/sh
# The laws of devices on SwiftShader and lavapipe at once: gpu:0 and gpu:1 of one list of drivers.
# usage: two_drivers.sh test_conformance FILTER; ends with 77 where one of them is not installed.
lavapipe=/usr/share/vulkan/icd.d/lvp_icd.$(uname -m).json
swiftshader=${PETZVAL_SWIFTSHADER:-/usr/lib/chromium/vk_swiftshader_icd.json}
for driver in "$lavapipe" "$swiftshader"; do
    [ -f "$driver" ] && continue
    echo "skipped: $driver is not there (Debian: mesa-vulkan-drivers, chromium-common; \$PETZVAL_SWIFTSHADER names it elsewhere)"
    exit 77
done
VK_ICD_FILENAMES=$lavapipe:$swiftshader exec "$1" --gtest_filter="$2"
