// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/quadrature/known_rules.hpp"

#include <map>
#include <mutex>

namespace extremal {
namespace {

/// Of one kind, by the number of nodes. References to what is in a map stay valid.
class KnownRules {
public:
    explicit KnownRules(Rule<double> (*make)(int)) : make_(make) {}

    const Rule<double>& of(int n) {
        const std::lock_guard lock(mutex_);
        const auto found = rules_.find(n);
        return found != rules_.end() ? found->second : rules_.emplace(n, make_(n)).first->second;
    }

private:
    Rule<double> (*make_)(int);
    std::mutex mutex_;
    std::map<int, Rule<double>> rules_;
};

}  // namespace

const Rule<double>& knownGauss(int n) {
    static KnownRules rules(&gauss<double>);
    return rules.of(n);
}
const Rule<double>& knownLobatto(int n) {
    static KnownRules rules(&lobatto<double>);
    return rules.of(n);
}

}  // namespace extremal
