// Instances as the host makes them from descriptions.
#pragma once

#include "stage.h"

namespace ofx_check {

std::unique_ptr<ofx::Effect> instance_of(ofx::Effect& descriptor, const ofx::Effect& described,
                                         const std::string& context, const Cast& cast, const Setup& setup);
// False if the effect has no parameter of that name, or it does not take the value.
bool set_param(ofx::Effect& effect, const std::string& name, const std::string& value);

}  // namespace ofx_check
