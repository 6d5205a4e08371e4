// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene's document with one of its schemes alone.
#pragma once

#include <cstddef>
#include <utility>

#include "engine/core/value.hpp"

namespace extremal {

/// Keeps this scheme, which is switched on, and nothing to show or observe.
inline void keepAlone(Value& document, std::size_t scheme) {
    Value own = document.find("schemes")->asArray()[scheme];
    own.set("enabled", true);
    document.set("schemes", Value::Array{std::move(own)});
    document.set("views", Value::Array{});
    document.set("observe", Value::Array{});
}

}  // namespace extremal
