// SPDX-License-Identifier: GPL-3.0-or-later
/// The plane of a view that can add starts: the columns of its axes and, of a section, the column that passes
/// zero.
#pragma once

#include <optional>
#include <string>

#include "engine/model/system.hpp"
#include "engine/view/view.hpp"

namespace extremal {

struct ViewPlane {
    std::string x, y;
    std::string at = {};  ///< of a section; else empty
};

/// Of a section or of a view of one column against another, with what the view leaves out; none of others.
std::optional<ViewPlane> planeOf(const View& view, const System& system);

/// The fields of the keys `starts` and `spread`.
std::vector<FieldInfo> startsFields();

}  // namespace extremal
