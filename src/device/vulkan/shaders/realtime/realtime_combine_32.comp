// The result as rgba32f.
#version 450
#extension GL_GOOGLE_include_directive : require
#define RESULT rgba32f
#include "realtime_combine.glsl"
