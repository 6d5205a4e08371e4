#include "engine/quadrature/tensor.hpp"

namespace extremal {

bool isTensorRule(const Settings& quadrature) { return quadrature.type == "product"; }

Settings tensorPart(const Settings& quadrature, std::string_view direction) {
    const Value* const part = quadrature.find(direction);
    if (!isTensorRule(quadrature) || !part || !part->isObject()) return {};
    Settings rule;
    for (const auto& [key, value] : part->asObject()) {
        if (key == "type" && value.isString())
            rule.type = value.asString();
        else
            rule.keys.emplace_back(key, value);
    }
    return rule;
}

}  // namespace extremal
