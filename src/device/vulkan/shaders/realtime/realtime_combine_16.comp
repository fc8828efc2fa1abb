// The result as rgba16f.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define RESULT rgba16f
#include "realtime_combine.glsl"
