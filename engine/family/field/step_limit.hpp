// SPDX-License-Identifier: GPL-3.0-or-later
/// The largest step of a field on its mesh, checked before a run.
#pragma once

#include <string>

#include "engine/family/family.hpp"
#include "engine/model/field/spatial_form.hpp"

namespace extremal {

/// An error for a step that is longer than `longest`, unless the scheme allows it. `of`: what the limit is
/// of, for people: "leapfrog on this mesh of 64 x 64 nodes".
void refuseLongerStep(double longest, const std::string& of, const SchemeCase& scheme, Findings& findings);

/// An error for a step with step * sqrt(Lambda) > limit, unless the scheme allows it: Lambda is the largest
/// eigenvalue of the elements (SpatialForm::largestEigenvalue) at the start. `limit`: largest step *
/// frequency of the scheme in time; `name` of the scheme, for people.
void checkFieldStep(const SpatialForm& form, double limit, const SchemeCase& scheme, const std::string& name,
                    Findings& findings);

}  // namespace extremal
