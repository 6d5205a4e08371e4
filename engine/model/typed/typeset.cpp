// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/typeset.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/text/text.hpp"

namespace extremal::typed {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 37> greek = {
    {{"alpha", "α"},   {"beta", "β"},    {"gamma", "γ"},   {"delta", "δ"},  {"epsilon", "ε"}, {"zeta", "ζ"},
     {"eta", "η"},     {"theta", "θ"},   {"iota", "ι"},    {"kappa", "κ"},  {"lambda", "λ"},  {"mu", "μ"},
     {"nu", "ν"},      {"xi", "ξ"},      {"omicron", "ο"}, {"rho", "ρ"},    {"sigma", "σ"},   {"tau", "τ"},
     {"upsilon", "υ"}, {"phi", "φ"},     {"chi", "χ"},     {"psi", "ψ"},    {"omega", "ω"},   {"varphi", "φ"},
     {"Gamma", "Γ"},   {"Delta", "Δ"},   {"Theta", "Θ"},   {"Lambda", "Λ"}, {"Xi", "Ξ"},      {"Pi", "Π"},
     {"Sigma", "Σ"},   {"Upsilon", "Υ"}, {"Phi", "Φ"},     {"Psi", "Ψ"},    {"Omega", "Ω"},   {"Mu", "Μ"},
     {"Rho", "Ρ"}}};

/// A name as a letter or word, and an index below it.
struct SplitName {
    std::string base, index;
    std::string word;  ///< the base as it was typed: "theta"
};

SplitName splitName(const std::string& name) {
    SplitName result;
    const auto underscore = name.find('_');
    std::size_t end = underscore;
    if (end == std::string::npos) {
        end = name.size();
        while (end > 1 && name[end - 1] >= '0' && name[end - 1] <= '9') --end;
        result.index = name.substr(end);
    } else {
        result.index = name.substr(underscore + 1);
    }
    result.base = result.word = name.substr(0, end);
    for (const auto& [word, letter] : greek)
        if (result.base == word) {
            result.base = letter;
            break;
        }
    return result;
}

/// An index that is a name: that of the momentum p_theta is a letter as well.
std::string indexText(const std::string& index) {
    const SplitName parts = splitName(index);
    return parts.base == parts.word ? index : parts.base + parts.index;
}

std::string plainIndex(const std::string& index) {
    if (index.empty()) return {};
    const bool isNumber =
        std::all_of(index.begin(), index.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!isNumber) return "_" + indexText(index);
    static constexpr std::array<const char*, 10> digits = {"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};
    std::string text;
    for (const char c : index) text += digits[static_cast<std::size_t>(c - '0')];
    return text;
}

/// A function as TeX has it, or sets one that it does not have.
std::string texFunction(const std::string& name) {
    static constexpr std::array<std::pair<const char*, const char*>, 13> known = {{{"sin", "sin"},
                                                                                   {"cos", "cos"},
                                                                                   {"tan", "tan"},
                                                                                   {"sinh", "sinh"},
                                                                                   {"cosh", "cosh"},
                                                                                   {"tanh", "tanh"},
                                                                                   {"exp", "exp"},
                                                                                   {"log", "ln"},
                                                                                   {"asin", "arcsin"},
                                                                                   {"acos", "arccos"},
                                                                                   {"atan", "arctan"},
                                                                                   {"max", "max"},
                                                                                   {"min", "min"}}};
    for (const auto& [own, tex] : known)
        if (name == own) return std::string("\\") + tex;
    return "\\operatorname{" + name + "}";
}

/// A name in TeX, under so many dots.
std::string texName(const SplitName& parts, int dots) {
    const bool isLetter = parts.word.size() == 1;
    std::string text = parts.base != parts.word ? "\\" + parts.word
                       : isLetter               ? parts.word
                                                : "\\mathrm{" + parts.word + "}";
    if (dots > 0) text = (dots == 1 ? "\\dot{" : "\\ddot{") + text + "}";
    if (parts.index.empty()) return text;
    const SplitName index = splitName(parts.index);
    const bool isNumber = index.word[0] >= '0' && index.word[0] <= '9';
    const bool isName =
        index.base != index.word || (!isNumber && index.word.size() == 1 && !index.index.empty());
    return text + "_{" + (isName ? texName(index, 0) : parts.index) + "}";
}

/// p / q with a small q, if the number is one.
bool isFraction(double x, double& p, double& q) {
    for (q = 1; q <= 64; ++q) {
        p = x * q;
        if (std::fabs(p) < 1e6 && std::fabs(p - std::round(p)) < 1e-13 * std::fabs(p)) {
            p = std::round(p);
            return true;
        }
    }
    return false;
}

class Printer {
public:
    Printer(const Graph& graph, const Formula& formula, TextForm form)
        : graph_(graph), formula_(formula), isRich_(form == TextForm::rich), isTex_(form == TextForm::tex) {}

    std::string sum(int node) {
        const Graph::Node& here = graph_.at(node);
        if (here.kind != Graph::Kind::sum) return term(node, 1, true);
        std::vector<std::pair<std::string, Graph::Operand>> terms;
        for (const Graph::Operand& o : here.operands)
            terms.emplace_back(rank(o.node) + term(o.node, 1, true), o);
        std::sort(terms.begin(), terms.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        // A sum that can start without a sign does.
        const auto positive =
            std::find_if(terms.begin(), terms.end(), [](const auto& t) { return t.second.factor > 0; });
        if (positive != terms.end() && positive->first[0] == terms[0].first[0])
            std::rotate(terms.begin(), positive, positive + 1);
        std::string text;
        for (const auto& [key, o] : terms) text += term(o.node, o.factor, text.empty());
        if (here.number != 0) text += signedNumber(here.number, text.empty());
        return text;
    }

private:
    /// Accelerations first, then velocities, then the rest.
    char rank(int node) const {
        const int d = formula_.dimension();
        const auto has = [&](int from, int to) {
            return graph_.dependsOn({node}, [&](int s) { return s >= from && s < to; });
        };
        if (has(2 * d + 1, 3 * d + 1)) return 'a';
        return has(d, 2 * d) ? 'b' : 'c';
    }
    std::string sign(bool isNegative, bool isFirst) const {
        const std::string minus = isTex_ ? "-" : "−";
        if (isFirst) return isNegative ? minus : "";
        return isNegative ? " " + minus + " " : " + ";
    }
    std::string signedNumber(double x, bool isFirst) const {
        return sign(x < 0, isFirst) + numberText(std::fabs(x));
    }
    std::string numberText(double x) const {
        if (x == std::numbers::pi) return isTex_ ? "\\pi" : "π";
        double p = 0, q = 1;
        if (isFraction(x, p, q) && q > 1 && std::fabs(x) * 1000 != std::round(std::fabs(x) * 1000))
            return isTex_ ? fraction(formatCount(p), formatCount(q)) : formatCount(p) + "/" + formatCount(q);
        std::string text = formatNumber(x, 8);
        if (const auto e = text.find('e'); isTex_ && e != std::string::npos)
            text = text.substr(0, e) + " \\cdot 10^{" + text.substr(e + 1) + "}";
        return text;
    }
    static std::string fraction(const std::string& above, const std::string& below) {
        return "\\frac{" + above + "}{" + below + "}";
    }
    std::string symbol(int s) const {
        const int d = formula_.dimension();
        if (s == formula_.time()) return italic("t");
        if (s >= formula_.firstParameter())
            return named(formula_.parameters[static_cast<std::size_t>(s - formula_.firstParameter())].first,
                         0);
        const int primes = s < d ? 0 : s < 2 * d ? 1 : 2;
        const int i = s < d ? s : s < 2 * d ? s - d : s - 2 * d - 1;
        return named(formula_.coordinates[static_cast<std::size_t>(i)], primes);
    }
    std::string italic(const std::string& text) const { return isRich_ ? "<i>" + text + "</i>" : text; }
    std::string named(const std::string& name, int primes) const {
        const SplitName parts = splitName(name);
        if (isTex_) return texName(parts, primes);
        std::string text = italic(parts.base);
        if (!parts.index.empty())
            text += isRich_ ? "<sub>" + indexText(parts.index) + "</sub>" : plainIndex(parts.index);
        if (primes > 0) text += primes == 1 ? "′" : "″";
        return text;
    }
    bool isAtom(int node) const {
        const Graph::Node& n = graph_.at(node);
        return n.kind == Graph::Kind::symbol || (n.kind == Graph::Kind::number && n.number >= 0) ||
               (n.kind == Graph::Kind::call && n.function == Function::abs);
    }
    std::string inBrackets(const std::string& text) const {
        return isTex_ ? "\\left(" + text + "\\right)" : "(" + text + ")";
    }
    std::string bracketed(int node) { return inBrackets(sum(node)); }
    std::string atom(int node) { return isAtom(node) ? factorText(node, 1) : bracketed(node); }
    std::string raised(const std::string& base, const std::string& exponent) const {
        if (isRich_) return base + "<sup>" + exponent + "</sup>";
        if (isTex_) return base + "^{" + exponent + "}";
        if (exponent == "2") return base + "²";
        if (exponent == "3") return base + "³";
        if (exponent == "4") return base + "⁴";
        return base + "^" + (exponent.size() == 1 ? exponent : "(" + exponent + ")");
    }
    static bool isComparison(Function f) {
        return f == Function::less || f == Function::lessOrEqual || f == Function::equal ||
               f == Function::notEqual;
    }
    std::string relation(const Graph::Node& n) {
        const auto sign = [&]() -> std::string {
            if (n.function == Function::equal) return " = ";
            if (n.function == Function::notEqual) return isTex_ ? " \\ne " : " ≠ ";
            if (n.function == Function::lessOrEqual) return isTex_ ? " \\le " : " ≤ ";
            return isRich_ ? " &lt; " : " < ";
        };
        return sum(n.operands[0].node) + sign() + sum(n.operands[1].node);
    }
    std::string comparison(const Graph::Node& n, const std::string& exponent) {
        const std::string text = inBrackets(relation(n));
        return exponent.empty() ? text : raised(text, exponent);
    }
    /// An argument, where a comparison needs no brackets.
    std::string whole(int node, bool isOfChoice) {
        const Graph::Node& n = graph_.at(node);
        const bool isBare = isOfChoice && n.kind == Graph::Kind::call && isComparison(n.function);
        return isBare ? relation(n) : sum(node);
    }
    /// With a prime for each derivative.
    static std::string lookUpName(const Graph::Node& n) {
        static constexpr std::array<const char*, 4> primes = {"", "′", "″", "‴"};
        return std::string(Interpolant::functionName(n.table->kind())) +
               primes[static_cast<std::size_t>(n.order)];
    }
    std::string callText(const Graph::Node& n, const std::string& exponent) {
        const std::string first = sum(n.operands[0].node);
        if (n.function == Function::abs) return isTex_ ? "\\left|" + first + "\\right|" : "|" + first + "|";
        if (n.function == Function::power) return raised(atom(n.operands[0].node), sum(n.operands[1].node));
        if (isComparison(n.function)) return comparison(n, exponent);
        std::string function(name(n.function));
        if (n.table) function = lookUpName(n);
        if (isTex_) function = texFunction(function);
        if (!exponent.empty()) function = raised(function, exponent);
        if (n.operands.size() > 1) {
            std::string arguments = first;
            for (std::size_t k = 1; k < n.operands.size(); ++k)
                arguments += ", " + whole(n.operands[k].node, n.function == Function::choose);
            if (n.function == Function::choose)
                arguments.replace(0, first.size(), whole(n.operands[0].node, true));
            return function + inBrackets(arguments);
        }
        return graph_.at(n.operands[0].node).kind == Graph::Kind::symbol ? function + " " + first
                                                                         : function + inBrackets(first);
    }
    /// node ^ exponent, exponent > 0.
    std::string factorText(int node, double exponent) {
        const Graph::Node& n = graph_.at(node);
        if (exponent == 0.5) return isTex_ ? "\\sqrt{" + sum(node) + "}" : "√" + atom(node);
        if (n.kind == Graph::Kind::call && n.function != Function::abs && n.function != Function::power)
            return callText(n, exponent == 1 ? "" : numberText(exponent));
        if (exponent != 1) return raised(atom(node), numberText(exponent));
        switch (n.kind) {
            case Graph::Kind::number:
                return numberText(n.number);
            case Graph::Kind::symbol:
                return symbol(n.symbol);
            case Graph::Kind::call:
                return callText(n, {});
            case Graph::Kind::sum:
            case Graph::Kind::product:
                break;
        }
        return bracketed(node);
    }
    /// Parameters, coordinates and time, functions, velocities, accelerations: as one would write it.
    std::string factorKey(const Graph::Operand& o) {
        const Graph::Node& n = graph_.at(o.node);
        const int d = formula_.dimension();
        if (n.kind != Graph::Kind::symbol) return (rank(o.node) == 'c' ? "3" : "4") + factorText(o.node, 1);
        const int s = n.symbol;
        const int group = s >= formula_.firstParameter() ? 0 : s > 2 * d ? 7 : s >= d && s < 2 * d ? 6 : 2;
        return std::to_string(group) + std::to_string(1000 + s);
    }
    std::string term(int node, double coefficient, bool isFirst) {
        const Graph::Node& n = graph_.at(node);
        const std::string start = sign(coefficient < 0, isFirst);
        double p = std::fabs(coefficient), q = 1;
        if (!isFraction(std::fabs(coefficient), p, q)) {
            p = std::fabs(coefficient);
            q = 1;
        }
        std::vector<Graph::Operand> factors{{node, 1}};
        if (n.kind == Graph::Kind::product) factors = n.operands;
        if (n.kind == Graph::Kind::sum && n.operands.size() == 1 && n.number == 0)
            return term(n.operands[0].node, coefficient * n.operands[0].factor, isFirst);
        std::vector<std::pair<std::string, Graph::Operand>> sorted;
        for (const Graph::Operand& o : factors) sorted.emplace_back(factorKey(o), o);
        std::sort(sorted.begin(), sorted.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<std::string> above, below;
        if (p != 1) above.push_back(numberText(p));
        if (q != 1) below.push_back(numberText(q));
        for (const auto& [key, o] : sorted)
            (o.factor > 0 ? above : below).push_back(factorText(o.node, std::fabs(o.factor)));
        if (above.empty()) above.emplace_back("1");
        if (isTex_ && !below.empty()) return start + fraction(joined(above), joined(below));
        std::string text = start + joined(above);
        if (!below.empty()) text += " / " + (below.size() == 1 ? below[0] : "(" + joined(below) + ")");
        return text;
    }
    static std::string joined(const std::vector<std::string>& parts) {
        std::string text;
        for (const std::string& part : parts) text += (text.empty() ? "" : " ") + part;
        return text;
    }

    const Graph& graph_;
    const Formula& formula_;
    bool isRich_, isTex_;
};

}  // namespace

std::string symbolOf(const std::string& name) {
    const SplitName parts = splitName(name);
    return parts.base + plainIndex(parts.index);
}

std::string typeset(const Graph& graph, int node, const Formula& formula, TextForm form) {
    return Printer(graph, formula, form).sum(node);
}

std::vector<std::string> equationLines(const Formula& formula, TextForm form) {
    constexpr std::size_t longest = 3000;
    const auto symbolic = differentiate(formula);
    std::vector<std::string> lines;
    for (const int equation : symbolic->equations) {
        lines.push_back(typeset(symbolic->graph, equation, formula, form) + " = 0");
        if (lines.back().size() > longest) lines.back() = "(too long to show)";
    }
    return lines;
}

}  // namespace extremal::typed
