// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/parts.hpp"

#include <algorithm>

namespace extremal {

std::string joinTitles(const std::vector<const PartInfo*>& parts, std::string_view last) {
    std::string text;
    for (std::size_t i = 0; i < parts.size(); ++i)
        text += std::string(i == 0 ? "" : i + 1 < parts.size() ? ", " : last) + std::string(parts[i]->title);
    return text;
}

std::string untaken(const Takes& takes, const Parts& parts) {
    std::vector<const PartInfo*> missed = parts.needs();
    std::erase_if(missed, [&](const PartInfo* part) { return takes.contains(*part); });
    return joinTitles(missed, " and ");
}

bool isTaken(const Takes& takes, const Parts& parts) {
    const std::vector<const PartInfo*> needs = parts.needs();
    return takes.isEverything() ||
           (!needs.empty() &&
            std::all_of(needs.begin(), needs.end(), [&](const PartInfo* p) { return takes.contains(*p); }));
}

std::string neededInstead(const Takes& takes, const Parts& parts) {
    if (isTaken(takes, parts)) return {};
    const std::string missed = untaken(takes, parts);
    const std::vector<const PartInfo*> needs = parts.needs();
    const bool isPartly =
        std::any_of(needs.begin(), needs.end(), [&](const PartInfo* p) { return takes.contains(*p); });
    return isPartly ? "a problem without " + missed : joinTitles(takes.all(), " or ");
}

}  // namespace extremal
