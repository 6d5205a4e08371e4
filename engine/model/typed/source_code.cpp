#include "engine/model/typed/source_code.hpp"

#include "engine/core/text.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape_code.hpp"

namespace extremal::typed {
namespace {

class Lines {
public:
    Lines(const Formula& formula, Language language)
        : formula_(formula), isPython_(language == Language::python) {}

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

private:
    /// Always with a point, as 1/2 would be 0 in C++.
    static std::string number(double x) {
        std::string text = formatNumber(x);
        if (text.find_first_of(".en") == std::string::npos) text += ".0";
        return text;
    }
    std::string symbol(int s) const {
        const int d = formula_.dimension();
        if (s == formula_.time()) return "t";
        if (s >= formula_.firstParameter())
            return "k_" + formula_.parameters[static_cast<std::size_t>(s - formula_.firstParameter())].first;
        return (s < d ? "q[" : "v[") + std::to_string(s < d ? s : s - d) + "]";
    }
    std::string call(std::uint32_t function, const std::string& arguments) const {
        const auto f = static_cast<Function>(function);
        const std::string in = "(" + arguments + ")";
        if (f == Function::sign)
            return isPython_ ? "float(np.sign" + in + ")"
                             : "((" + arguments + " > 0) - (" + arguments + " < 0))";
        if (f == Function::abs) return isPython_ ? "abs" + in : "std::fabs" + in;
        const std::string name(f == Function::power ? "pow" : typed::name(f));
        return (isPython_ ? "math." : "std::") + name + in;
    }
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
                return "1.0 / " + a;
            case Op::sqrt:
                return (isPython_ ? "math.sqrt(" : "std::sqrt(") + a + ")";
            case Op::call:
            case Op::sinCos:
                return call(i.c, a);
            case Op::call2:
                return call(i.c, a + ", " + b);
        }
        return {};
    }

    const Formula& formula_;
    bool isPython_;
};

}  // namespace

std::vector<std::string> derivativeLines(const Formula& formula, Language language) {
    const auto symbolic = differentiate(formula);
    Code code(symbolic->graph);
    std::vector<std::uint32_t> gradient, hessian;
    for (const int node : symbolic->gradient) gradient.push_back(code.value(node));
    for (const int node : symbolic->hessian) hessian.push_back(code.value(node));
    const Lines text(formula, language);
    const bool isPython = language == Language::python;
    const std::string end = isPython ? "" : ";";
    std::vector<std::string> lines;
    const auto& items = code.items();
    for (std::size_t i = 0; i < items.size(); ++i)
        lines.push_back((isPython ? "" : "const double ") + Lines::value(static_cast<std::uint32_t>(i)) +
                        " = " + text.item(items[i]) + end);
    for (std::size_t i = 0; i < gradient.size(); ++i)
        lines.push_back("g[" + std::to_string(i) + "] = " + Lines::value(gradient[i]) + end);
    std::size_t at = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j, ++at)
            lines.push_back("H[" + std::to_string(i) + (isPython ? ", " : "][") + std::to_string(j) +
                            "] = " + Lines::value(hessian[at]) + end);
    return lines;
}

}  // namespace extremal::typed
