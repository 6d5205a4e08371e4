// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/single_scheme.hpp"

#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {

std::size_t schemeNamed(const ResolvedScene& scene, const std::string& label) {
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i) {
        const SchemeSpec& spec = scene.schemes[i].spec;
        if (label.empty() ? spec.isEnabled : spec.label == label) return i;
        labels.push_back(spec.label);
    }
    if (label.empty())
        throw InvalidScene("--scheme", "no scheme is enabled", "name one of " + joinNames(labels));
    throw InvalidScene("--scheme", "there is no scheme \"" + label + "\"", suggestName(label, labels));
}

}  // namespace extremal
