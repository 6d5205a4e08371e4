// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/derivatives_found.hpp"

#include <algorithm>
#include <list>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/core/work.hpp"

namespace extremal::typed {
namespace {

/// The last findings. Its lock is held for a moment only, while GiNaC may be at work for seconds.
class Memory {
public:
    struct Key {
        std::vector<std::string> names;
        std::string text;
        std::vector<double> exponents;
        bool operator==(const Key&) const = default;
    };
    std::optional<DerivativesFound> recall(const Key& key) {
        const std::lock_guard lock(mutex_);
        const auto found =
            std::find_if(known_.begin(), known_.end(), [&](const auto& k) { return k.first == key; });
        if (found == known_.end()) return {};
        known_.splice(known_.begin(), known_, found);
        return found->second;
    }
    void keep(const Key& key, const DerivativesFound& finding) {
        constexpr std::size_t remembered = 24;
        const std::lock_guard lock(mutex_);
        known_.emplace_front(key, finding);
        if (known_.size() > remembered) known_.pop_back();
    }

private:
    std::mutex mutex_;
    std::list<std::pair<Key, DerivativesFound>> known_;
};

/// A control by all that its derivatives depend on.
std::string textOf(const std::pair<std::string, Expression>& control) {
    std::string text = control.first + " = " + control.second.text;
    for (const Expression::Node& node : control.second.nodes)
        if (node.table) text += " " + node.name + " " + std::to_string(node.table->hash());
    return text;
}

}  // namespace

std::shared_ptr<const SymbolicLagrangian> differentiate(const Formula& formula, const std::stop_token& stop,
                                                        double maxWork) {
    static Memory memory;
    static std::mutex working;

    const ResolvedFormula resolved = resolve(formula);
    Memory::Key key{formula.coordinates, formula.text, resolved.exponents};
    key.names.emplace_back();
    for (const auto& parameter : formula.parameters) key.names.push_back(parameter.first);
    for (const auto& control : formula.controls) key.names.push_back(textOf(control));
    std::optional<DerivativesFound> finding = memory.recall(key);
    if (!finding) {
        const std::lock_guard lock(working);
        finding = memory.recall(key);  // another thread may have been at it
        if (!finding) {
            const work::Measured measured;
            finding = findDerivatives(formula, resolved, stop, maxWork);
            finding->work = measured.spent();
            if (finding->result || finding->error) memory.keep(key, *finding);
        }
    }
    work::spendOnce("derivatives of " + formula.text, finding->work);
    if (finding->error) throw *finding->error;
    return finding->result;
}

}  // namespace extremal::typed
