// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/source_code.hpp"

#include <algorithm>

#include "engine/core/text/text.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape/tape_code.hpp"

namespace extremal::typed {
namespace {

class Lines {
public:
    /// `d`: how many coordinates are those of the state; the others are parameters.
    Lines(const Formula& formula, int d, const Code& code, Language language)
        : formula_(formula), d_(d), code_(code), isPython_(language == Language::python) {
        for (const Code::Item& each : code.items())
            hasBranches_ =
                hasBranches_ || (each.kind == Code::Kind::instruction && each.code.op == Op::choose);
    }
    std::string item(const Code::Item& item) const {
        switch (item.kind) {
            case Code::Kind::input:
                return symbol(static_cast<int>(item.code.a));
            case Code::Kind::constant:
                return number(item.number);
            case Code::Kind::instruction:
                return instruction(item.code);
        }
        return {};
    }
    static std::string value(std::uint32_t at) { return "x" + std::to_string(at); }
    /// What all values are made from.
    std::vector<std::string> lines() const {
        std::vector<std::string> made;
        // A branch that is not taken may be infinite or not a number, and says nothing about it.
        if (isPython_ && hasBranches_) made.emplace_back("np.seterr(all='ignore')");
        const auto& items = code_.items();
        for (std::size_t i = 0; i < items.size(); ++i)
            made.push_back((isPython_ ? "" : "const double ") + value(static_cast<std::uint32_t>(i)) + " = " +
                           item(items[i]) + (isPython_ ? "" : ";"));
        return made;
    }

private:
    /// Always with a point, as 1/2 would be 0 in C++.
    static std::string number(double x) {
        std::string text = formatNumber(x);
        if (text.find_first_of(".en") == std::string::npos) text += ".0";
        return text;
    }
    std::string symbol(int s) const {
        const int all = formula_.dimension();
        if (s == formula_.time()) return "t";
        if (s >= formula_.firstParameter())
            return "k_" + formula_.parameters[static_cast<std::size_t>(s - formula_.firstParameter())].first;
        if (s >= all) return "v[" + std::to_string(s - all) + "]";
        return s < d_ ? "q[" + std::to_string(s) + "]"
                      : "k_" + formula_.coordinates[static_cast<std::size_t>(s)];
    }
    /// Functions that are not one call in both languages; @ and # are the arguments. Where an argument is not
    /// a number, comparisons are false in a program, and not a number in an expression.
    struct Written {
        Function function;
        const char *cpp, *python;
    };
    static constexpr Written written[] = {
        {Function::sign, "double((@ > 0) - (@ < 0))", "float(np.sign(@))"},
        {Function::abs, "std::fabs(@)", "abs(@)"},
        {Function::floor, "std::floor(@)", "np.floor(@)"},
        {Function::ceil, "std::ceil(@)", "np.ceil(@)"},
        {Function::round, "std::round(@)", "np.copysign(np.floor(abs(@) + 0.5), @)"},
        {Function::heaviside, "0.5 * (1 + (@ > 0) - (@ < 0))", "float(0.5 + 0.5 * np.sign(@))"},
        {Function::max, "(@ < # ? # : @)", "(# if @ < # else @)"},
        {Function::min, "(# < @ ? # : @)", "(# if # < @ else @)"},
        {Function::less, "double(@ < #)", "float(@ < #)"},
        {Function::lessOrEqual, "double(@ <= #)", "float(@ <= #)"},
        {Function::equal, "double(@ == #)", "float(@ == #)"},
        {Function::notEqual, "double(@ != #)", "float(@ != #)"},
    };
    static std::string filled(std::string_view form, const std::string& a, const std::string& b) {
        std::string text;
        for (const char c : form) text += c == '@' ? a : c == '#' ? b : std::string(1, c);
        return text;
    }
    std::string call(std::uint32_t function, const std::string& a, const std::string& b = {}) const {
        const auto f = static_cast<Function>(function);
        for (const Written& each : written)
            if (each.function == f) return filled(isPython_ ? each.python : each.cpp, a, b);
        const std::string name(f == Function::power ? "pow" : typed::name(f));
        return (isPython_ ? pythonModule(f) + pythonName(name) : "std::" + name) + "(" + a +
               (b.empty() ? "" : ", " + b) + ")";
    }
    /// The module math throws outside of a function's domain, where a branch that is not taken may be.
    std::string pythonModule(Function f) const {
        return hasBranches_ && f != Function::erf && f != Function::erfc ? "np." : "math.";
    }
    std::string pythonName(const std::string& name) const {
        if (!hasBranches_) return name;
        if (name == "atan2") return "arctan2";
        if (name == "pow") return "power";
        return name.starts_with("a") ? "arc" + name.substr(1) : name;
    }
    /// One expression, so that the line needs nothing outside of it: of the pieces from `first` to before
    /// `end` by halves, as languages limit how deep brackets may be nested.
    std::string lookUp(const LookUp& look, const std::string& x, std::size_t first, std::size_t end) const {
        if (end - first == 1) return piece(look, x, first);
        const std::size_t middle = (first + end) / 2;
        const std::string low = lookUp(look, x, first, middle), high = lookUp(look, x, middle, end),
                          isLow = x + " < " + inBrackets(look.table->abscissae()[middle - 1]);
        return isPython_ ? "(" + low + " if " + isLow + " else " + high + ")"
                         : "(" + isLow + " ? " + low + " : " + high + ")";
    }
    std::string piece(const LookUp& look, const std::string& x, std::size_t k) const {
        const Interpolant& table = *look.table;
        const std::string s = "(" + x + " - " + inBrackets(table.base(k)) + ")";
        std::string text;
        for (int j = table.degree(); j >= look.order; --j) {
            double factor = table.coefficient(k, j);
            for (int i = 0; i < look.order; ++i) factor *= j - i;
            text = text.empty() ? number(factor) : "(" + text + ") * " + s + " + " + inBrackets(factor);
        }
        return text;
    }
    static std::string inBrackets(double x) { return x < 0 ? "(" + number(x) + ")" : number(x); }
    std::string instruction(const Instruction& i) const {
        const std::string a = value(i.a), b = value(i.b), c = value(i.c);
        switch (i.op) {
            case Op::add:
                return a + " + " + b;
            case Op::subtract:
                return a + " - " + b;
            case Op::multiply:
                return a + " * " + b;
            case Op::multiplyAdd:
                return a + " * " + b + " + " + c;
            case Op::multiplySubtract:
                return a + " * " + b + " - " + c;
            case Op::subtractProduct:
                return c + " - " + a + " * " + b;
            case Op::negate:
                return "-" + a;
            case Op::reciprocal:
                return "1.0 / " + (isPython_ && hasBranches_ ? "np.float64(" + a + ")" : a);
            case Op::sqrt:
                return (!isPython_ ? "std::sqrt(" : hasBranches_ ? "np.sqrt(" : "math.sqrt(") + a + ")";
            case Op::call:
            case Op::sinCos:
                return call(i.c, a);
            case Op::call2:
                return call(i.c, a, b);
            case Op::choose:
                return isPython_ ? "(" + b + " if " + a + " != 0.0 else " + c + ")"
                                 : "(" + a + " != 0.0 ? " + b + " : " + c + ")";
            case Op::lookUp:
                return lookUp(code_.tables()[i.c], a, 0, code_.tables()[i.c].table->pieces());
        }
        return {};
    }

    const Formula& formula_;
    int d_;
    const Code& code_;
    bool isPython_, hasBranches_ = false;
};

}  // namespace

std::vector<std::string> derivativeLines(const Formula& formula, Language language) {
    const auto symbolic = differentiate(formula);
    Code code(symbolic->graph);
    std::vector<std::uint32_t> gradient, hessian;
    for (const int node : symbolic->gradient) gradient.push_back(code.value(node));
    for (const int node : symbolic->hessian) hessian.push_back(code.value(node));
    const bool isPython = language == Language::python;
    const std::string end = isPython ? "" : ";";
    std::vector<std::string> lines = Lines(formula, formula.dimension(), code, language).lines();
    for (std::size_t i = 0; i < gradient.size(); ++i)
        lines.push_back("g[" + std::to_string(i) + "] = " + Lines::value(gradient[i]) + end);
    std::size_t at = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j, ++at)
            lines.push_back("H[" + std::to_string(i) + (isPython ? ", " : "][") + std::to_string(j) +
                            "] = " + Lines::value(hessian[at]) + end);
    return lines;
}

std::vector<std::string> parameterLines(const Formula& formula, const std::vector<std::string>& parameters,
                                        Language language) {
    // Parameters as coordinates: these derivatives are a block of the Hessian.
    Formula wider = formula;
    wider.coordinates.insert(wider.coordinates.end(), parameters.begin(), parameters.end());
    std::erase_if(wider.parameters, [&](const auto& each) {
        return std::find(parameters.begin(), parameters.end(), each.first) != parameters.end();
    });
    const auto symbolic = differentiate(wider);
    Code code(symbolic->graph);
    const int d = formula.dimension(), u = static_cast<int>(parameters.size());
    const auto entry = [&](int i, int j) {
        return symbolic->hessian[static_cast<std::size_t>(i > j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i)];
    };
    std::vector<std::string> places;
    std::vector<std::uint32_t> values;
    for (int i = 0; i < 2 * d; ++i)
        for (int k = 0; k < u; ++k) {
            const int node = entry(i < d ? i : i + u, d + k);
            if (symbolic->graph.isZero(node)) continue;
            values.push_back(code.value(node));
            places.push_back(language == Language::python
                                 ? "B[" + std::to_string(i) + ", " + std::to_string(k) + "]"
                                 : "B[" + std::to_string(i * u + k) + "]");
        }
    std::vector<std::string> lines = Lines(wider, d, code, language).lines();
    for (std::size_t i = 0; i < places.size(); ++i)
        lines.push_back(places[i] + " = " + Lines::value(values[i]) +
                        (language == Language::python ? "" : ";"));
    return lines;
}

}  // namespace extremal::typed
