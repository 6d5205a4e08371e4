// SPDX-License-Identifier: GPL-3.0-or-later
/// One scheme of a scene: by its label, or a document with it alone.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "engine/core/value.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// Keeps this scheme, which is switched on, and nothing to show or observe.
inline void keepAlone(Value& document, std::size_t scheme) {
    Value own = document.find("schemes")->asArray()[scheme];
    own.set("enabled", true);
    document.set("schemes", Value::Array{std::move(own)});
    document.set("views", Value::Array{});
    document.set("observe", Value::Array{});
}

/// The place of the scheme with this label, or, empty, of the first that is enabled. Throws InvalidScene
/// ("--scheme") where there is none.
std::size_t schemeNamed(const ResolvedScene& scene, const std::string& label);

}  // namespace extremal
