// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/multiscale/fewer_harmonics.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

/// What the keys say of a space. A degree is 0 where the space does not say it.
struct Contents {
    int slow = 0, fast = 0;
    std::vector<int> harmonics;

    /// Of one coordinate; of the fast ones, if the space says that of them.
    int functions() const {
        int all = std::max(slow, fast) + 1;
        for (const int degree : harmonics) all += 2 * (degree + 1);
        return all;
    }
    bool operator==(const Contents&) const = default;
};

Contents contentsOf(const Settings& space) {
    Contents all;
    all.slow = space.integer("degree");
    const Value* const harmonics = space.find("harmonics");
    if (!harmonics || !harmonics->isArray()) return {};
    for (const Value& degree : harmonics->asArray()) {
        if (!degree.isNumber()) return {};
        all.harmonics.push_back(static_cast<int>(degree.asNumber()));
    }
    const Value* const fast = space.find("fast");
    if (!fast || fast->isNull()) return all;
    const Value* const degree = fast->isObject() ? fast->find("degree") : nullptr;
    if (!degree || fast->asObject().size() != 1) return {};
    all.fast = static_cast<int>(degree->asNumber());
    return all;
}

Settings with(const Settings& space, const Contents& contents) {
    Settings smaller = space;
    Value::Array degrees;
    for (const int degree : contents.harmonics) degrees.emplace_back(static_cast<double>(degree));
    setKey(smaller, "degree", static_cast<double>(contents.slow));
    setKey(smaller, "harmonics", std::move(degrees));
    if (contents.fast > 0)
        setKey(smaller, "fast", Value::Object{{"degree", static_cast<double>(contents.fast)}});
    return smaller;
}

}  // namespace

std::vector<SmallerSpace> fewerHarmonics(const Settings& space, const Settings&) {
    const Value* const variables = space.find("variables");
    if (space.type != "oscillatory" || (variables && !variables->isNull())) return {};
    const Contents whole = contentsOf(space);
    std::vector<Contents> all;
    for (std::size_t kept = whole.harmonics.size(); kept >= 1; --kept)
        for (const int lower : {0, 1})
            for (const int slower : {0, 1, 2}) {
                Contents less = whole;
                less.harmonics.resize(kept);
                for (int& degree : less.harmonics) degree = std::max(0, degree - lower);
                less.slow = std::max(1, less.slow - slower);
                if (less.fast > 0) less.fast = std::max(1, less.fast - slower);
                if (less != whole && std::find(all.begin(), all.end(), less) == all.end())
                    all.push_back(std::move(less));
            }
    std::stable_sort(all.begin(), all.end(),
                     [](const Contents& a, const Contents& b) { return a.functions() > b.functions(); });
    std::vector<SmallerSpace> spaces;
    for (const Contents& less : all)
        spaces.push_back({with(space, less), static_cast<double>(less.functions()) / whole.functions()});
    return spaces;
}

std::string textOfHarmonics(const Settings& space) {
    const Contents has = contentsOf(space);
    std::vector<std::string> degrees;
    for (const int degree : has.harmonics) degrees.push_back(std::to_string(degree));
    return "degree " + std::to_string(has.slow) +
           (has.fast > 0 ? ", " + std::to_string(has.fast) + " on the fast coordinates" : "") +
           ", harmonics of degrees " + joinNames(degrees);
}

}  // namespace extremal
