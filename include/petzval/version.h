// The version of these headers. The build, the package files and the program take their number from here.
#pragma once

#define PETZVAL_VERSION "0.1.0"
#define PETZVAL_VERSION_MAJOR 0
#define PETZVAL_VERSION_MINOR 1
#define PETZVAL_VERSION_PATCH 0
