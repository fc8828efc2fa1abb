// Everything in petzval::petzval. The optional components have their own headers: petzval/files.h for
// petzval::files, petzval/scene.h for petzval::scenes.
#pragma once

#include "petzval/camera.h"
#include "petzval/compare.h"
#include "petzval/deep.h"
#include "petzval/defocus.h"
#include "petzval/depth.h"
#include "petzval/develop.h"
#include "petzval/dynamic_range.h"
#include "petzval/export.h"
#include "petzval/glare.h"
#include "petzval/image.h"
#include "petzval/lens.h"
#include "petzval/lens_facts.h"
#include "petzval/lens_kernel.h"
#include "petzval/look.h"
#include "petzval/look_json.h"
#include "petzval/names.h"
#include "petzval/place.h"
#include "petzval/result.h"
#include "petzval/session.h"
#include "petzval/version.h"
