#include "engine/quadrature/tensor.hpp"

namespace extremal {

bool isTensorRule(const Settings& quadrature) { return quadrature.type == "product"; }

namespace {

Settings partOf(const Settings& quadrature, std::string_view name) {
    const Value* const part = quadrature.find(name);
    if (!part || !part->isObject()) return {};
    Settings rule;
    for (const auto& [key, value] : part->asObject()) {
        if (key == "type" && value.isString())
            rule.type = value.asString();
        else
            rule.keys.emplace_back(key, value);
    }
    return rule;
}

}  // namespace

bool isTermRule(const Settings& quadrature) { return quadrature.type == "terms"; }

Settings termPart(const Settings& quadrature, std::string_view term) {
    return isTermRule(quadrature) ? partOf(quadrature, term) : Settings{};
}

Settings tensorPart(const Settings& quadrature, std::string_view direction) {
    return isTensorRule(quadrature) ? partOf(quadrature, direction) : Settings{};
}

}  // namespace extremal
