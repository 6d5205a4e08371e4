// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/derivatives_found.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <map>
#include <mutex>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "engine/core/text/text.hpp"
#include "engine/core/work.hpp"
#include "engine/model/typed/symbolic_functions.hpp"

namespace extremal::typed {

namespace {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::exvector;
using GiNaC::is_a;

/// Formulas larger than this are opaque to GiNaC where they are operands: a derivative then refers to them
/// instead of repeating them, as in automatic differentiation, and no product of many factors explodes.
constexpr int maxOpenSize = 64;
constexpr std::size_t maxFactors = 12;
/// Exact numbers grow under powers; beyond this many bits the base is made opaque.
constexpr double maxBits = 2000;
constexpr int maxGraph = 2'000'000;

struct TooLong : std::exception {};
struct Stopped : std::exception {};

/// Number of parts, counted no further than one beyond the limit.
int countParts(const ex& e, int limit) {
    int count = 1;
    for (std::size_t i = 0; i < e.nops() && count <= limit; ++i) count += countParts(e.op(i), limit - count);
    return count;
}

class Engine;

/// A symbol of the formula, a number that GiNaC must not see through, or a part of the formula under a name.
class Leaf final : public GiNaC::symbol {
public:
    enum class Kind { symbol, number, part };
    Leaf(Engine& engine, Kind kind, int index, double value = 0)
        : engine_(&engine), kind_(kind), index_(index), value_(value) {}
    Leaf(const Leaf&) = default;

    unsigned get_domain() const override { return GiNaC::domain::real; }
    Leaf* duplicate() const override {
        Leaf* copy = new Leaf(*this);
        copy->setflag(GiNaC::status_flags::dynallocated);
        return copy;
    }
    Kind kind() const { return kind_; }
    int index() const { return index_; }
    double value() const { return value_; }

protected:
    ex derivative(const GiNaC::symbol& s) const override;

private:
    Engine* engine_;
    Kind kind_;
    int index_;
    double value_;
};

struct SameEx {
    bool operator()(const ex& a, const ex& b) const { return a.is_equal(b); }
};
struct HashEx {
    std::size_t operator()(const ex& e) const { return e.gethash(); }
};

/// One differentiation, from the formula to the graph; everything of GiNaC lives and dies in here.
class Engine {
public:
    Engine(const Formula& formula, const ResolvedFormula& resolved, const std::stop_token& stop,
           double maxWork)
        : formula_(formula), resolved_(resolved), stop_(stop), maxWork_(maxWork) {
        const int symbols = formula.firstParameter() + static_cast<int>(formula.parameters.size());
        for (int i = 0; i < symbols; ++i) symbols_.push_back(Leaf(*this, Leaf::Kind::symbol, i));
    }

    SymbolicLagrangian run() {
        const int d = formula_.dimension();
        if (d > static_cast<int>(fewCoordinates)) return runByTerms();
        const ex L = build(static_cast<int>(resolved_.expression.nodes.size()) - 1);
        result_.value = flatten(L);
        exvector gradient, hessian;
        for (int i = 0; i < 2 * d; ++i) gradient.push_back(L.diff(symbol(i)));
        for (int i = 0; i < 2 * d; ++i)
            for (int j = 0; j <= i; ++j) hessian.push_back(gradient[place(i)].diff(symbol(j)));
        for (const ex& e : gradient) result_.gradient.push_back(flatten(e));
        for (const ex& e : hessian) result_.hessian.push_back(flatten(e));
        if (d <= 12) {
            for (int i = 0; i < d; ++i) result_.equations.push_back(flatten(equation(i, gradient, hessian)));
        }
        return std::move(result_);
    }

    /// Called at every leaf that a derivative meets: between two calls little can happen. Counted and not
    /// timed, so that a formula is refused on every machine or on none.
    void tick() {
        constexpr double units = 5e3;  // 3 to 20 microseconds were measured
        constexpr long often = 64;
        if (++ticks_ % often != 0) return;
        if (stop_.stop_requested()) throw Stopped();
        work::spend(often * units);
        if (static_cast<double>(ticks_) * units > maxWork_) throw TooLong();
    }
    const ex& derivativeOfPart(int part, const GiNaC::symbol& s) {
        const int with = ex_to<Leaf>(s).index();
        const auto key = std::pair(part, with);
        if (const auto known = derivatives_.find(key); known != derivatives_.end()) return known->second;
        const ex whole = parts_[place(part)];  // a copy: more parts may be made on the way
        ex d = opaque(whole.diff(s));
        return derivatives_.emplace(key, std::move(d)).first->second;
    }

private:
    static std::size_t place(int i) { return static_cast<std::size_t>(i); }

    /// A part of a sum: coefficients without coordinates, times a formula.
    struct Term {
        int node;
        ex coefficient;
    };
    /// Where there are many coordinates: of each term by those alone that are in it. Without this a chain of
    /// N bodies would take N^3 derivatives of sums, nearly all of them 0.
    SymbolicLagrangian runByTerms() {
        const int d = formula_.dimension();
        std::vector<Term> terms;
        collect(static_cast<int>(resolved_.expression.nodes.size()) - 1, 1, terms);
        std::vector<Graph::Operand> value;
        std::map<int, std::vector<Graph::Operand>> gradient, hessian;
        for (const Term& term : terms) {
            const ex part = term.coefficient * build(term.node);
            value.push_back({flatten(part)});
            const std::vector<int> own = coordinatesIn(term.node);
            for (const int i : own) {
                const ex first = part.diff(symbol(i));
                if (first.is_zero()) continue;
                gradient[i].push_back({flatten(first)});
                for (const int j : own) {
                    if (j > i) break;
                    const ex second = first.diff(symbol(j));
                    if (!second.is_zero()) hessian[i * (i + 1) / 2 + j].push_back({flatten(second)});
                }
            }
        }
        Graph& graph = result_.graph;
        const int zero = graph.number(0);
        result_.value = graph.sum(0, value);
        result_.gradient.assign(place(2 * d), zero);
        result_.hessian.assign(place(d * (2 * d + 1)), zero);
        for (const auto& [i, operands] : gradient) result_.gradient[place(i)] = graph.sum(0, operands);
        for (const auto& [k, operands] : hessian) result_.hessian[place(k)] = graph.sum(0, operands);
        return std::move(result_);
    }
    /// Down to what is no sum, through factors without coordinates.
    void collect(int root, const ex& factor, std::vector<Term>& terms) {
        std::vector<Term> waiting{{root, factor}};
        while (!waiting.empty()) {
            const Term here = waiting.back();
            waiting.pop_back();
            const Expression::Node& n = node(here.node);
            const bool isConstant = resolved_.constant[place(here.node)].has_value();
            if (isConstant || resolved_.symbol[place(here.node)] >= 0) {
                terms.push_back(here);
            } else if (n.kind == Operator::negate) {
                waiting.push_back({n.left, -here.coefficient});
            } else if (n.kind == Operator::add || n.kind == Operator::subtract) {
                waiting.push_back({n.right, n.kind == Operator::add ? here.coefficient : -here.coefficient});
                waiting.push_back({n.left, here.coefficient});
            } else if (n.kind == Operator::multiply && coordinatesIn(n.left).empty()) {
                waiting.push_back({n.right, here.coefficient * build(n.left)});
            } else if (n.kind == Operator::multiply && coordinatesIn(n.right).empty()) {
                waiting.push_back({n.left, here.coefficient * build(n.right)});
            } else if (n.kind == Operator::divide && coordinatesIn(n.right).empty()) {
                const ex below = build(n.right);
                if (below.is_zero()) throw ExpressionError("divides by zero", n.position);
                waiting.push_back({n.left, here.coefficient * powerOf(opaque(below), -1)});
            } else {
                terms.push_back(here);
            }
        }
    }
    /// Symbols of places and velocities in a part of the formula, in order.
    std::vector<int> coordinatesIn(int root) const {
        std::vector<int> waiting{root}, found;
        while (!waiting.empty()) {
            const int n = waiting.back();
            waiting.pop_back();
            if (const int s = resolved_.symbol[place(n)]; s >= 0) {
                if (s < 2 * formula_.dimension()) found.push_back(s);
                continue;
            }
            for (const int operand : {node(n).left, node(n).right, node(n).third})
                if (operand >= 0) waiting.push_back(operand);
        }
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

    const Leaf& symbol(int i) const { return ex_to<Leaf>(symbols_[place(i)]); }

    ex equation(int i, const exvector& gradient, const exvector& hessian) {
        const int d = formula_.dimension();
        const auto second = [&](int a, int b) {
            return hessian[place(a >= b ? a * (a + 1) / 2 + b : b * (b + 1) / 2 + a)];
        };
        exvector terms;
        for (int j = 0; j < d; ++j) {
            terms.push_back(second(d + i, d + j) * symbols_[place(formula_.acceleration(j))]);
            terms.push_back(second(d + i, j) * symbols_[place(d + j)]);
        }
        terms.push_back(gradient[place(d + i)].diff(symbol(formula_.time())));
        terms.push_back(-gradient[place(i)]);
        return GiNaC::add(terms);
    }

    // From the parsed text to GiNaC.

    const Expression::Node& node(int n) const { return resolved_.expression.nodes[place(n)]; }

    /// An exact fraction where the number is a short one, so that 0.5 m * 2 is m; else opaque.
    ex numeric(double value) {
        // Convergents p / q of the continued fraction.
        double x = value, whole = std::floor(x), p0 = 1, q0 = 0, p = whole, q = 1;
        while (std::fabs(p) < 1e15 && q < 1e6) {
            if (p / q == value) return ex(static_cast<long>(p)) / static_cast<long>(q);
            if (!(x > whole)) break;
            x = 1 / (x - whole);
            whole = std::floor(x);
            p0 = std::exchange(p, whole * p + p0);
            q0 = std::exchange(q, whole * q + q0);
        }
        return opaqueNumber(value);
    }
    ex opaqueNumber(double value) {
        const auto known = numbers_.find(value);
        if (known != numbers_.end()) return known->second;
        return numbers_.emplace(value, Leaf(*this, Leaf::Kind::number, 0, value)).first->second;
    }
    /// Bits that exact numbers in the expression may have; powers multiply them.
    static double bitsOf(const ex& e) {
        if (is_a<GiNaC::numeric>(e)) {
            const auto& n = ex_to<GiNaC::numeric>(e);
            return n.is_rational() ? n.numer().int_length() + n.denom().int_length() : 0;
        }
        double sum = 0;
        if (is_a<GiNaC::add>(e) || is_a<GiNaC::mul>(e))
            for (std::size_t i = 0; i < e.nops(); ++i) sum += bitsOf(e.op(i));
        return sum;
    }
    ex opaque(const ex& e) {
        if (countParts(e, maxOpenSize) <= maxOpenSize) return e;
        return newPart(e);
    }
    ex newPart(const ex& e) {
        parts_.push_back(e);
        return Leaf(*this, Leaf::Kind::part, static_cast<int>(parts_.size()) - 1);
    }
    ex productOf(exvector factors) {
        while (factors.size() > maxFactors) {
            exvector groups;
            for (std::size_t i = 0; i < factors.size(); i += maxFactors) {
                const auto from = factors.begin() + static_cast<std::ptrdiff_t>(i);
                const auto to =
                    factors.begin() + static_cast<std::ptrdiff_t>(std::min(i + maxFactors, factors.size()));
                groups.push_back(newPart(GiNaC::mul(exvector(from, to))));
            }
            factors = std::move(groups);
        }
        return GiNaC::mul(factors);
    }
    ex powerOf(const ex& base, const ex& exponent) {
        if (!is_a<GiNaC::numeric>(exponent)) {
            // (2^x)^(c/x) and 2^x 2^(c - x) are 2^c, whose exact value has c bits.
            const bool isFraction = is_a<GiNaC::numeric>(base) && !base.is_zero() && !base.is_equal(1);
            return GiNaC::pow(isFraction ? opaqueNumber(ex_to<GiNaC::numeric>(base).to_double()) : base,
                              exponent);
        }
        const double size = std::fabs(ex_to<GiNaC::numeric>(exponent).to_double());
        const bool isTame = bitsOf(base) * size <= maxBits && size <= 1e6;
        return GiNaC::pow(isTame || is_a<Leaf>(base) ? base : newPart(base), exponent);
    }
    ex build(int n) {
        tick();
        const Expression::Node& here = node(n);
        if (const auto& constant = resolved_.constant[place(n)]) return numeric(*constant);
        if (const int s = resolved_.symbol[place(n)]; s >= 0) return symbols_[place(s)];
        switch (here.kind) {
            case Operator::negate:
                return -build(here.left);
            case Operator::add:
            case Operator::subtract: {
                exvector terms;
                // Down the left side in a loop: a sum may have thousands of terms.
                int at = n;
                for (; isSum(at); at = node(at).left) {
                    const ex right = build(node(at).right);
                    terms.push_back(node(at).kind == Operator::add ? right : -right);
                }
                terms.push_back(build(at));
                return GiNaC::add(terms);
            }
            case Operator::multiply:
            case Operator::divide: {
                exvector factors;
                int at = n;
                for (; isProduct(at); at = node(at).left) {
                    const ex right = opaque(build(node(at).right));
                    if (node(at).kind == Operator::divide && right.is_zero())
                        throw ExpressionError("divides by zero", node(at).position);
                    factors.push_back(node(at).kind == Operator::multiply ? right : powerOf(right, -1));
                }
                factors.push_back(opaque(build(at)));
                return productOf(std::move(factors));
            }
            case Operator::power:
                return powerOf(opaque(build(here.left)), opaque(build(here.right)));
            case Operator::call:
                return call(here);
            case Operator::number:
            case Operator::name:
                break;
        }
        return 0;
    }
    bool isSum(int n) const {
        const Operator kind = node(n).kind;
        return (kind == Operator::add || kind == Operator::subtract) && !resolved_.constant[place(n)];
    }
    bool isProduct(int n) const {
        const Operator kind = node(n).kind;
        return (kind == Operator::multiply || kind == Operator::divide) && !resolved_.constant[place(n)];
    }
    ex call(const Expression::Node& here) {
        if (here.name == "stumpff")
            throw ExpressionError("has stumpff(...) of something that moves", here.position,
                                  "it stands in numbers, and in the functions of a space");
        const ex x = opaque(build(here.left));
        if (here.table) {
            tables_.push_back(here.table);
            return lookedUp(x, ex(static_cast<int>(tables_.size()) - 1), ex(0), ex(here.table->degree()));
        }
        if (here.third >= 0) return choice(x, opaque(build(here.right)), opaque(build(here.third)));
        return here.right >= 0 ? callOfTwo(here.name, x, opaque(build(here.right))) : callOfOne(here.name, x);
    }
    ex callOfOne(std::string_view name, const ex& x) {
        if (name == "sin") return GiNaC::sin(x);
        if (name == "cos") return GiNaC::cos(x);
        if (name == "tan") return GiNaC::tan(x);
        if (name == "asin") return GiNaC::asin(x);
        if (name == "acos") return GiNaC::acos(x);
        if (name == "atan") return GiNaC::atan(x);
        if (name == "sinh") return GiNaC::sinh(x);
        if (name == "cosh") return GiNaC::cosh(x);
        if (name == "tanh") return GiNaC::tanh(x);
        if (name == "asinh") return GiNaC::asinh(x);
        if (name == "acosh") return GiNaC::acosh(x);
        if (name == "atanh") return GiNaC::atanh(x);
        if (name == "exp") return GiNaC::exp(x);
        if (name == "log") return GiNaC::log(x);
        if (name == "log10") return GiNaC::log(x) * numeric(std::numbers::log10e);
        if (name == "sqrt") return powerOf(x, ex(1) / 2);
        if (name == "abs") return magnitude(x);
        if (name == "erf") return errorFunction(x);
        if (name == "erfc") return complementaryErrorFunction(x);
        if (name == "floor") return floorOf(x);
        if (name == "ceil") return ceilOf(x);
        if (name == "round") return rounded(x);
        if (name == "heaviside") return heavisideOf(x);
        return signum(x);
    }
    /// Whether it is 1 or 0 whatever its arguments.
    static bool isTruth(const ex& e) {
        if (!is_a<GiNaC::function>(e)) return false;
        const std::string name = ex_to<GiNaC::function>(e).get_name();
        return name == "isLess" || name == "isLessOrEqual" || name == "isEqualTo" || name == "isNotEqualTo";
    }
    ex callOfTwo(std::string_view name, const ex& a, const ex& b) {
        if (name == "atan2") return GiNaC::atan2(a, b);
        if (name == "hypot") return hypotenuse(a, b);
        if (name == "mod") return a - b * floorOf(productOf({a, powerOf(b, -1)}));
        if (name == "max") return greaterOf(a, b);
        if (name == "min") return smallerOf(a, b);
        if (name == "<") return isLess(a, b);
        if (name == "<=") return isLessOrEqual(a, b);
        if (name == "==") return isEqualTo(a, b);
        if (name == "!=") return isNotEqualTo(a, b);
        const ex truth = isTruth(b) ? b : ex(isNotEqualTo(b, 0));
        return name == "and" ? choice(a, truth, 0) : choice(a, 1, truth);
    }

    // From GiNaC to the graph.

    int flatten(const ex& e) {
        tick();
        if (const auto known = flat_.find(e); known != flat_.end()) return known->second;
        if (result_.graph.size() > maxGraph) throw TooLong();
        const int made = flattened(e);
        flat_.emplace(e, made);
        return made;
    }
    int flattened(const ex& e) {
        Graph& graph = result_.graph;
        if (is_a<GiNaC::numeric>(e)) {
            const auto& n = ex_to<GiNaC::numeric>(e);
            return graph.number(n.is_real() ? n.to_double() : std::nan(""));
        }
        if (is_a<GiNaC::constant>(e)) return flattened(e.evalf());
        if (is_a<Leaf>(e)) {
            const Leaf& leaf = ex_to<Leaf>(e);
            if (leaf.kind() == Leaf::Kind::number) return graph.number(leaf.value());
            if (leaf.kind() == Leaf::Kind::part) return flatten(parts_[place(leaf.index())]);
            return graph.symbol(leaf.index());
        }
        std::vector<Graph::Operand> operands;
        const bool isSumOrProduct = is_a<GiNaC::add>(e) || is_a<GiNaC::mul>(e);
        for (std::size_t i = 0; i < e.nops(); ++i) operands.push_back({flatten(e.op(i))});
        if (isSumOrProduct) return is_a<GiNaC::add>(e) ? graph.sum(0, operands) : graph.product(operands);
        if (is_a<GiNaC::power>(e)) return graph.call(Function::power, operands[0].node, operands[1].node);
        const std::string called = ex_to<GiNaC::function>(e).get_name();
        if (called == "lookedUp")
            return graph.lookUp(tables_[static_cast<std::size_t>(ex_to<GiNaC::numeric>(e.op(1)).to_int())],
                                ex_to<GiNaC::numeric>(e.op(2)).to_int(), operands[0].node);
        std::optional<Function> function = functionNamed(called);
        for (const auto& [own, meant] : ownFunctions)
            if (own == called) function = meant;
        if (!function) throw std::runtime_error("no meaning for " + called);
        return graph.call(*function, operands[0].node, operands.size() > 1 ? operands[1].node : -1,
                          operands.size() > 2 ? operands[2].node : -1);
    }

    const Formula& formula_;
    const ResolvedFormula& resolved_;
    std::stop_token stop_;
    double maxWork_;
    long ticks_ = 0;
    exvector symbols_, parts_;
    std::vector<std::shared_ptr<const Interpolant>> tables_;
    std::map<double, ex> numbers_;
    std::map<std::pair<int, int>, ex> derivatives_;
    std::unordered_map<ex, int, HashEx, SameEx> flat_;
    SymbolicLagrangian result_;
};

ex Leaf::derivative(const GiNaC::symbol& s) const {
    engine_->tick();
    return kind_ == Kind::part ? engine_->derivativeOfPart(index_, s) : GiNaC::symbol::derivative(s);
}

}  // namespace

DerivativesFound findDerivatives(const Formula& formula, const ResolvedFormula& resolved,
                                 const std::stop_token& stop, double maxWork) {
    try {
        return {std::make_shared<const SymbolicLagrangian>(Engine(formula, resolved, stop, maxWork).run()),
                {}};
    } catch (const ExpressionError& e) {
        return {nullptr, e};
    } catch (const Stopped&) {
        return {};
    } catch (const TooLong&) {
        return {nullptr,
                ExpressionError("takes more than " + formatNumber(maxWork) + " operations to differentiate",
                                0, "a shorter formula, or fewer coordinates")};
    } catch (const std::bad_alloc&) {
        return {nullptr, ExpressionError("needs too much memory to differentiate", 0, "a shorter formula")};
    } catch (const std::exception&
                 e) {  // GiNaC's pole_error and the like: a part is infinite whatever the state is
        return {nullptr, ExpressionError("is not finite: " + std::string(e.what()), 0)};
    }
}

}  // namespace extremal::typed
