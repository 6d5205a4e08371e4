// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/tape/tape_forms.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

namespace extremal::typed {
namespace {

/// What a term is a function of, where that is one sum or one symbol: its node, else -1.
int formOf(const Graph& graph, int term) {
    const Graph::Node& node = graph.at(term);
    if (node.kind == Graph::Kind::symbol || node.kind == Graph::Kind::sum) return term;
    const bool isOfOne =
        (node.kind == Graph::Kind::product || node.kind == Graph::Kind::call) && node.operands.size() == 1;
    if (!isOfOne) return -1;
    const int form = node.operands.front().node;
    const Graph::Kind kind = graph.at(form).kind;
    return kind == Graph::Kind::sum || kind == Graph::Kind::symbol ? form : -1;
}

/// A sum from which multiples of other sums are taken.
class Remainder {
public:
    Remainder(const Graph& graph, const Graph::Node& sum)
        : graph_(graph), number_(sum.number), terms_(sum.operands), left_(terms_.size()) {
        for (std::size_t k = 0; k < terms_.size(); ++k) places_.emplace(terms_[k].node, k);
    }

    /// Takes a multiple of a form all of whose terms are here, such that one of them or more vanish; of
    /// several the least.
    std::optional<double> take(int form) {
        const Graph::Node& of = graph_.at(form);
        double multiple = std::numeric_limits<double>::infinity();
        for (const auto& [node, factor] : of.operands) {
            const auto found = places_.find(node);
            if (found == places_.end() || terms_[found->second].factor == 0) return {};
            const double own = terms_[found->second].factor / factor;
            if (std::fabs(own) < std::fabs(multiple)) multiple = own;
        }
        number_ = without(number_, multiple * of.number);
        for (const auto& [node, factor] : of.operands) {
            double& own = terms_[places_.at(node)].factor;
            own = without(own, multiple * factor);
            if (own == 0) --left_;
        }
        return multiple;
    }
    double number() const { return number_; }
    std::size_t left() const { return left_ + (number_ != 0 ? 1 : 0); }
    const std::vector<Graph::Operand>& terms() const { return terms_; }

private:
    /// 0 where what is left is that of rounding.
    static double without(double whole, double part) {
        constexpr double roundOff = 4 * std::numeric_limits<double>::epsilon();
        const double rest = whole - part;
        return std::fabs(rest) <= roundOff * std::max(std::fabs(whole), std::fabs(part)) ? 0 : rest;
    }

    const Graph& graph_;
    double number_;
    std::vector<Graph::Operand> terms_;  ///< of factor 0: those that have vanished
    std::size_t left_;
    std::unordered_map<int, std::size_t> places_;
};

}  // namespace

SumByForms byForms(const Graph& graph, const Graph::Node& sum) {
    std::vector<int> forms;  // of terms, in their order
    std::unordered_map<int, std::vector<Graph::Operand>> ofForm;
    for (const Graph::Operand& term : sum.operands)
        if (const int form = formOf(graph, term.node); form >= 0 && ofForm.try_emplace(form).second)
            forms.push_back(form);
    SumByForms made{sum.number, {}, sum.operands};
    const auto isSum = [&](int form) { return graph.at(form).kind == Graph::Kind::sum; };
    if (std::none_of(forms.begin(), forms.end(), isSum)) return made;

    Remainder rest(graph, sum);
    const std::size_t before = rest.left();
    std::vector<Graph::Operand> taken;
    for (const int form : forms)
        if (const auto multiple = isSum(form) ? rest.take(form) : std::nullopt)
            taken.push_back({form, *multiple});
    if (!taken.empty() && rest.left() + taken.size() <= before) {
        made.number = rest.number();
        made.others = rest.terms();
        for (const Graph::Operand& each : taken) ofForm[each.node].push_back(each);
    }
    for (const Graph::Operand& term : made.others)
        if (const int form = formOf(graph, term.node); form >= 0 && term.factor != 0)
            ofForm[form].push_back(term);
    for (const int form : forms) {
        std::vector<Graph::Operand> terms = ofForm[form];
        if (terms.size() < 2) continue;
        const bool isNegative = terms.front().factor < 0;
        if (isNegative)
            for (Graph::Operand& term : terms) term.factor = -term.factor;
        made.groups.push_back({std::move(terms), isNegative});
    }
    std::erase_if(made.others, [&](const Graph::Operand& term) {
        const int form = formOf(graph, term.node);
        return term.factor == 0 || (form >= 0 && ofForm[form].size() > 1);
    });
    return made;
}

}  // namespace extremal::typed
