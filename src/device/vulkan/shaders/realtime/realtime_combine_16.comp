// The result as rgba16f.
#version 450
#extension GL_GOOGLE_include_directive : require
#define RESULT rgba16f
#include "realtime_combine.glsl"
