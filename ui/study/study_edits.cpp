// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/study_edits.hpp"

#include <algorithm>

#include "engine/scene/write/codec.hpp"

namespace extremal {

int indexOfScheme(const Scene& scene, const std::string& label) {
    const auto found = std::find_if(scene.schemes.begin(), scene.schemes.end(),
                                    [&](const SchemeSpec& s) { return s.label == label; });
    return found == scene.schemes.end() ? -1 : static_cast<int>(found - scene.schemes.begin());
}

std::vector<Edit> editsForPoint(const Scene& scene, const std::string& label, double step, double tolerance) {
    std::vector<std::pair<std::string, double>> numbers;
    if (step > 0) numbers.emplace_back("/schemes/*/step", step);
    if (tolerance > 0) numbers.emplace_back("/schemes/*/tolerance", tolerance);
    return numbers.empty() ? std::vector<Edit>{} : editsForRun(scene, label, numbers);
}

std::vector<Edit> editsForRun(const Scene& scene, const std::string& label,
                              const std::vector<std::pair<std::string, double>>& numbers) {
    const int index = indexOfScheme(scene, label);
    if (index < 0) return {};
    const std::string any = "/schemes/*", own = "/schemes/" + std::to_string(index);
    std::vector<Edit> edits;
    for (const auto& [pointer, value] : numbers)
        edits.push_back({pointer.starts_with(any) ? own + pointer.substr(any.size()) : pointer, value});
    if (!scene.schemes[static_cast<std::size_t>(index)].isEnabled) edits.push_back({own + "/enabled", true});
    return edits;
}

std::vector<Edit> editsForScheme(Scene scene, const SchemeSpec& scheme) {
    const int index = indexOfScheme(scene, scheme.label);
    const std::size_t at = index < 0 ? scene.schemes.size() : static_cast<std::size_t>(index);
    if (index < 0) scene.schemes.emplace_back();
    scene.schemes[at] = scheme;
    scene.schemes[at].isEnabled = true;
    return {{"/schemes/" + (index < 0 ? "-" : std::to_string(index)),
             toValue(scene).find("schemes")->asArray()[at]}};
}

}  // namespace extremal
