// SPDX-License-Identifier: GPL-3.0-or-later
/// Filling a model struct from the checked keys of a scene through its Field descriptors, and back.
#pragma once

#include <span>
#include <vector>

#include "engine/core/field.hpp"
#include "engine/core/settings.hpp"

namespace extremal {

template <class M>
M withParameters(const Settings& settings, const std::vector<Field<M>>& fields) {
    M model;
    for (const Field<M>& f : fields) model.*(f.member) = settings.number(f.info.key);
    return model;
}

template <class M>
std::vector<FieldInfo> infos(const std::vector<Field<M>>& fields) {
    std::vector<FieldInfo> result;
    for (const Field<M>& f : fields) result.push_back(f.info);
    return result;
}

}  // namespace extremal
