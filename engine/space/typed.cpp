// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/space/typed.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/core/algebra/long_numbers.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/exact_number.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"
#include "engine/space/orthonormal.hpp"
#include "engine/space/smooth_panels.hpp"

namespace extremal {
namespace {

constexpr double inSpace = 1e-20;  ///< distance of a function that is in the space
constexpr std::size_t mostFunctions = 32;
constexpr std::size_t mostKnots = 63;  ///< as many as equal cells have
constexpr int chebyshevNodes = 36;     ///< of a panel that 12 Gauss nodes integrate to 1e-24

std::string pointerOf(std::size_t function) { return "/space/functions/" + std::to_string(function); }

/// Values at 0 and 1, and slopes at the nodes of the panels, which with f(0) say everything.
template <class T>
struct Sampled {
    std::vector<LongVector<T>> vector;  ///< (f(0), sqrt(w_i) f'(c_i)), the norm being that of H1
    LongVector<T> end;                  ///< f(1)

    Sampled(const EvaluatedFormulas<T>& functions, const PanelNodes& nodes, bool isMirrored)
        : vector(functions.size()), end(functions.size()) {
        std::vector<T> value(functions.size()), slope(functions.size());
        const auto at = [&](const T& tau) { functions(isMirrored ? T(1 - tau) : tau, value, slope); };
        at(T(1));
        end = value;
        at(T(0));
        for (std::size_t a = 0; a < vector.size(); ++a) vector[a].push_back(value[a]);
        using std::sqrt;
        for (std::size_t i = 0; i < nodes.node.size(); ++i) {
            at(T(Quad(nodes.node[i])));
            const T root = sqrt(T(Quad(nodes.weight[i])));
            for (std::size_t a = 0; a < vector.size(); ++a)
                vector[a].push_back((isMirrored ? T(-root) : root) * slope[a]);
        }
    }
};

template <class T>
LongVector<T> powerOf(int j, const PanelNodes& nodes) {
    using std::pow;
    using std::sqrt;
    LongVector<T> v{T(j == 0 ? 1 : 0)};
    for (std::size_t i = 0; i < nodes.node.size(); ++i) {
        const T tau = T(Quad(nodes.node[i]));
        T power(j > 0 ? j : 0);
        for (int k = 1; k < j; ++k) power *= tau;
        v.push_back(sqrt(T(Quad(nodes.weight[i]))) * power);
    }
    return v;
}

void report(const SmoothPanels& panels, const Formulas& formulas) {
    using Fault = SmoothPanels::Fault;
    if (panels.fault == Fault::none) return;
    const std::string pointer = pointerOf(static_cast<std::size_t>(panels.function));
    const std::string text = formulas.functions[static_cast<std::size_t>(panels.function)].text;
    const std::string place = formatNumber(panels.place, 6), at = " at tau = " + place;
    switch (panels.fault) {
        case Fault::none:
            break;
        case Fault::notFinite:
            throw InvalidScene(pointer, text + " is not finite at tau = " + formatNumber(panels.place, 4),
                               "functions are needed on the whole step, tau from 0 to 1");
        case Fault::jump:
            throw InvalidScene(pointer, text + " jumps" + at, "curves are continuous: another function");
        case Fault::infiniteSlope:
            throw InvalidScene(pointer, text + " has an infinite slope" + at, "another function");
        case Fault::kink:
            throw InvalidScene(
                pointer,
                (panels.exponent < 1.5 ? "the slope of " + text + " jumps" : text + " is not smooth") + at,
                "add \"knots\": [" + place + "]");
        case Fault::tooMany:
            throw InvalidScene(pointer, text + " varies too fast to be tabulated",
                               "a smaller step or a lower frequency");
    }
}

/// "sin(tau)^2 = 0.5 - 0.5*cos(2*tau)", the first function that those before it and after it give.
template <class T>
[[noreturn]] void refuseDependent(const Sampled<T>& sampled, const Formulas& formulas) {
    for (std::size_t a = 0; a < sampled.vector.size(); ++a) {
        const std::vector<LongVector<T>> before(sampled.vector.begin(),
                                                sampled.vector.begin() + static_cast<std::ptrdiff_t>(a));
        const Orthonormal<T> basis(before, 1e-30);
        LongVector<T> left = sampled.vector[a], combination(a, T(0));
        const T whole = norm(left);
        if (!(whole > 0))
            throw InvalidScene(pointerOf(a), formulas.functions[a].text + " is 0 on the whole step",
                               "leave it out");
        basis.remove(left, &combination);
        if (static_cast<double>(norm(left) / whole) > 1e-25) continue;
        std::string sum;
        for (std::size_t b = 0; b < a; ++b) {
            const auto c = -static_cast<double>(combination[b]);
            if (std::abs(c) < 1e-12) continue;
            const std::string factor = formatNumber(std::abs(c), 6), &text = formulas.functions[b].text;
            sum += sum.empty() ? (c < 0 ? "-" : "") : (c < 0 ? " - " : " + ");
            sum += text == "1" ? factor : factor == "1" ? text : factor + "*" + text;
        }
        throw InvalidScene(pointerOf(a),
                           "follows from the others: " + formulas.functions[a].text + " = " + sum,
                           "leave it out");
    }
    throw InvalidScene("/space/functions", "are not independent", "leave out those that follow from others");
}

/// The functions of the table's basis as combinations of the typed ones: 1, the interior ones, the last.
template <class T>
struct Basis {
    std::vector<LongVector<T>> coefficient;
    double sigma = 1;
    std::vector<double> distance;
    bool isSymmetric = false, isPolynomial = false;
};

/// v <- v - 2 u (u.v)/(u.u) over the vectors of a basis, which takes e_first to the direction of `to`.
template <class T>
void reflect(std::vector<LongVector<T>>& basis, std::size_t first, LongVector<T> to) {
    using std::abs;
    const T size = norm(to);
    for (T& x : to) x /= size;
    const bool isNegative = to.front() > 0;  // away from cancellation
    to.front() += isNegative ? T(1) : T(-1);
    const T square = dot(to, to);
    LongVector<T> along(basis.front().size(), T(0));
    for (std::size_t j = 0; j < to.size(); ++j) addTo(along, to[j], basis[first + j]);
    for (std::size_t j = 0; j < to.size(); ++j) addTo(basis[first + j], T(-2 * to[j] / square), along);
    if (isNegative)
        for (T& x : basis[first]) x = -x;
}

template <class T>
Basis<T> basisOf(const EvaluatedFormulas<T>& functions, const PanelNodes& nodes,
                 const Orthonormal<T>& orthonormal, const Sampled<T>& sampled, double lastCell) {
    Basis<T> basis;
    const std::size_t n = functions.size();
    basis.sigma = orthonormal.pivot.back();
    for (int j = 0; j <= static_cast<int>(n); ++j)
        basis.distance.push_back(orthonormal.distance(powerOf<T>(j, nodes)));
    if (!(basis.distance[0] < inSpace))
        throw InvalidScene("/space/functions",
                           "do not contain the constants, so the curve cannot start at rest", "add \"1\"");
    // q_0 = 1, and the others vanish at 0.
    basis.coefficient = orthonormal.coefficient;
    LongVector<T> one;
    for (const LongVector<T>& q : orthonormal.vector) one.push_back(q.front());
    reflect(basis.coefficient, 0, one);
    LongVector<T> ends;
    for (std::size_t j = 1; j < n; ++j) ends.push_back(dot(basis.coefficient[j], sampled.end));
    const T size = norm(ends);
    if (n < 2 || !(static_cast<double>(size) > 1e-12))
        throw InvalidScene("/space/functions",
                           "are all equal at 0 and 1, so the curve cannot leave its start", "add \"tau\"");
    // The second has the end to itself; it goes last, with the value 1 there.
    reflect(basis.coefficient, 1, ends);
    for (T& x : basis.coefficient[1]) x /= size;
    std::rotate(basis.coefficient.begin() + 1, basis.coefficient.begin() + 2, basis.coefficient.end());

    const Sampled<T> mirrored(functions, nodes, true);
    basis.isSymmetric = std::all_of(mirrored.vector.begin(), mirrored.vector.end(),
                                    [&](const auto& v) { return orthonormal.distance(v) < 1e-15; });
    // Polynomials on the last cell, which alone are extrapolated.
    std::vector<LongVector<T>> last(n), powers;
    const auto cut = [&](const LongVector<T>& v, const T& atEnd) {
        LongVector<T> part{atEnd};
        for (std::size_t i = 0; i < nodes.node.size(); ++i)
            if (Quad(nodes.node[i]) > lastCell) part.push_back(v[i + 1]);
        return part;
    };
    for (std::size_t a = 0; a < n; ++a) last[a] = cut(sampled.vector[a], sampled.end[a]);
    const Orthonormal<T> onLast(last, 1e-15);
    basis.isPolynomial = true;
    for (int j = 0; j < static_cast<int>(onLast.rank()); ++j)
        basis.isPolynomial = basis.isPolynomial && onLast.distance(cut(powerOf<T>(j, nodes), T(1))) < inSpace;
    return basis;
}

/// The adapted functions, in quadruple precision.
template <class T>
class Adapted {
public:
    Adapted(EvaluatedFormulas<T> functions, std::vector<LongVector<T>> coefficient)
        : functions_(std::move(functions)), coefficient_(std::move(coefficient)) {}

    void operator()(__float128 tau, std::span<__float128> value, std::span<__float128> derivative) const {
        std::vector<T> v(functions_.size()), d(functions_.size());
        functions_(T(Quad(tau)), v, d);
        value[0] = 1;
        derivative[0] = 0;
        for (std::size_t j = 1; j < coefficient_.size(); ++j) {
            value[j] = toQuad(dot(coefficient_[j], v)).backend().value();
            derivative[j] = toQuad(dot(coefficient_[j], d)).backend().value();
        }
    }

private:
    EvaluatedFormulas<T> functions_;
    std::vector<LongVector<T>> coefficient_;
};

/// Beyond the step: the polynomials of the last cell through as many Chebyshev points.
class Extrapolated {
public:
    Extrapolated(SampledFunctions inside, int size, double lastCell, int degree)
        : inside_(std::move(inside)), size_(static_cast<std::size_t>(size)) {
        for (int i = 0; i <= degree; ++i) {
            // Away from the ends, where a kink may be to one side.
            const double x = std::cos(std::numbers::pi * (2 * i + 1) / (2 * degree + 2));
            point_.push_back(Quad(lastCell) + (1 - Quad(lastCell)) * (1 - Quad(x)) / 2);
            std::vector<__float128> v(size_), d(size_);
            inside_(point_.back().backend().value(), v, d);
            value_.emplace_back(v.begin(), v.end());
        }
    }

    void operator()(__float128 tau, std::span<__float128> value, std::span<__float128> derivative) const {
        if (tau <= 1) return inside_(tau, value, derivative);
        std::fill(value.begin(), value.end(), __float128(0));
        std::fill(derivative.begin(), derivative.end(), __float128(0));
        for (std::size_t i = 0; i < point_.size(); ++i) {
            Quad cardinal(1), slope(0);
            for (std::size_t l = 0; l < point_.size(); ++l) {
                if (l == i) continue;
                const Quad scale = 1 / (point_[i] - point_[l]), factor = (Quad(tau) - point_[l]) * scale;
                slope = slope * factor + cardinal * scale;
                cardinal *= factor;
            }
            for (std::size_t a = 0; a < size_; ++a) {
                value[a] += (cardinal * value_[i][a]).backend().value();
                derivative[a] += (slope * value_[i][a]).backend().value();
            }
        }
    }

private:
    SampledFunctions inside_;
    std::size_t size_;
    std::vector<Quad> point_;
    std::vector<std::vector<Quad>> value_;
};

/// Chebyshev series of all functions and of their slopes, on each panel.
class Series {
public:
    Series(const SampledFunctions& functions, int size, std::span<const __float128> ends)
        : size_(static_cast<std::size_t>(size)) {
        constexpr int n = chebyshevNodes;
        std::vector<double> cosines(n * n);
        for (int k = 0; k < n; ++k)
            for (int i = 0; i < n; ++i)
                cosines[static_cast<std::size_t>(k * n + i)] =
                    std::cos(std::numbers::pi * k * (2 * i + 1) / (2 * n)) * (k == 0 ? 1.0 : 2.0) / n;
        std::vector<__float128> v(size_), d(size_);
        for (std::size_t j = 0; j + 1 < ends.size(); ++j) {
            start_.push_back(static_cast<double>(ends[j]));
            length_.push_back(static_cast<double>(ends[j + 1] - ends[j]));
            const std::size_t base = coefficient_.size();
            coefficient_.resize(base + 2 * size_ * n, 0);
            for (int i = 0; i < n; ++i) {
                const double x = std::cos(std::numbers::pi * (2 * i + 1) / (2 * n));
                functions((Quad(ends[j]) + (Quad(ends[j + 1]) - Quad(ends[j])) * (1 + Quad(x)) / 2)
                              .backend()
                              .value(),
                          v, d);
                for (std::size_t a = 0; a < size_; ++a)
                    for (std::size_t k = 0; k < n; ++k) {
                        const double c = cosines[k * n + static_cast<std::size_t>(i)];
                        coefficient_[base + (2 * a) * n + k] += c * static_cast<double>(v[a]);
                        coefficient_[base + (2 * a + 1) * n + k] += c * static_cast<double>(d[a]);
                    }
            }
        }
    }

    void operator()(double tau, std::span<double> value, std::span<double> derivative) const {
        const auto after = std::upper_bound(start_.begin() + 1, start_.end(), tau) - start_.begin();
        const auto j = static_cast<std::size_t>(after - 1);
        const double x = 2 * (tau - start_[j]) / length_[j] - 1;
        const double* c = coefficient_.data() + j * 2 * size_ * chebyshevNodes;
        for (std::size_t a = 0; a < size_; ++a) {
            value[a] = sum(c + (2 * a) * chebyshevNodes, x);
            derivative[a] = sum(c + (2 * a + 1) * chebyshevNodes, x);
        }
    }

private:
    /// By Clenshaw's recurrence.
    static double sum(const double* c, double x) {
        double next = 0, afterNext = 0;
        for (int k = chebyshevNodes - 1; k > 0; --k) {
            const double here = 2 * x * next - afterNext + c[k];
            afterNext = next;
            next = here;
        }
        return x * next - afterNext + c[0];
    }

    std::size_t size_;
    std::vector<double> start_, length_, coefficient_;
};

template <class T>
TypedSpace make(std::span<const double> cells, const SmoothPanels& panels, const PanelNodes& nodes,
                const EvaluatedFormulas<T>& functions, const Sampled<T>& sampled,
                const Orthonormal<T>& orthonormal) {
    const double lastCell = cells[cells.size() - 2];
    const Basis<T> basis = basisOf(functions, nodes, orthonormal, sampled, lastCell);
    TypedSpace made;
    made.sigma = basis.sigma;
    made.distance = basis.distance;
    Space<double>& space = made.space;
    space.size = static_cast<int>(functions.size());
    while (space.degree + 1 <= space.size &&
           basis.distance[static_cast<std::size_t>(space.degree) + 1] < inSpace)
        ++space.degree;
    space.hasKinks = cells.size() > 2;
    space.isSymmetric = basis.isSymmetric;
    if (space.hasKinks) space.cells.assign(cells.begin(), cells.end());
    space.isAdapted = true;
    space.continues = basis.isPolynomial;
    SampledFunctions exact = Adapted<T>(functions, basis.coefficient);
    space.evaluate = [series = std::make_shared<const Series>(exact, space.size, panels.ends)](
                         const double& tau, std::span<double> value, std::span<double> derivative) {
        (*series)(tau, value, derivative);
    };
    if (basis.isPolynomial) exact = Extrapolated(std::move(exact), space.size, lastCell, space.size - 1);
    space.evaluateQuadruple = std::move(exact);
    return made;
}

}  // namespace

Formulas formulasOf(const Settings& space) {
    Formulas formulas;
    const auto read = [](const Value& value, const std::string& pointer) {
        const std::string text = value.isString() ? value.asString() : formatNumber(value.asNumber());
        return atPlace(pointer, text, [&] { return parseExpression(text); });
    };
    if (const Value* functions = space.find("functions"))
        for (const Value& function : functions->asArray())
            formulas.functions.push_back(read(function, pointerOf(formulas.functions.size())));
    if (const Value* names = space.find("let"); names && names->isObject())
        for (const auto& [name, value] : names->asObject())
            formulas.names.emplace_back(name, read(value, "/space/let/" + name));
    if (space.find("h")) formulas.step = space.number("h");
    return formulas;
}

namespace {

/// As exact as the numbers in the functions: a kink is at 0.3, and not at the double nearest to it.
std::vector<__float128> exactCells(const Settings& space) {
    std::vector<__float128> cells{0};
    const Value* const knots = space.find("knots");
    if (knots && knots->isArray() && knots->asArray().size() > mostKnots)
        throw InvalidScene(
            "/space/knots",
            "are " + std::to_string(knots->asArray().size()) + ", the limit is " + std::to_string(mostKnots),
            "more cells than that are better taken as more steps");
    if (knots && knots->isArray())
        for (const Value& knot : knots->asArray()) {
            const std::string pointer = "/space/knots/" + std::to_string(cells.size() - 1);
            const __float128 exact = exactNumber(knot, pointer, "\"1/3\"").backend().value();
            const auto place = static_cast<double>(exact);
            if (!(place > 0 && place < 1))
                throw InvalidScene(pointer,
                                   "must be inside the step, between 0 and 1, got " + formatNumber(place));
            if (!(place > static_cast<double>(cells.back())))
                throw InvalidScene(pointer,
                                   "must be greater than the knot before it, got " + formatNumber(place),
                                   "knots are ascending and different");
            cells.push_back(exact);
        }
    cells.push_back(1);
    return cells;
}

}  // namespace

std::vector<double> cellsOf(const Settings& space) {
    std::vector<double> cells;
    for (const __float128 end : exactCells(space)) cells.push_back(static_cast<double>(end));
    return cells;
}

bool dependsOnStep(const Settings& space) {
    // Other spaces have a key of this name too, whose values are words.
    const Value* const typed = space.find("functions");
    return typed && typed->isArray() && formulasOf(space).dependOnStep();
}

Settings withStep(const Settings& space, double step) {
    if (!dependsOnStep(space)) return space;
    Settings known = space;
    for (auto& [key, value] : known.keys)
        if (key == "h") {
            value = step;
            return known;
        }
    known.keys.emplace_back("h", step);
    return known;
}

TypedSpace typedSpace(const Settings& settings) {
    const Formulas formulas = formulasOf(settings);
    const std::vector<double> cells = cellsOf(settings);
    if (formulas.functions.size() > mostFunctions)
        throw InvalidScene("/space/functions",
                           "are " + std::to_string(formulas.functions.size()) + ", the limit is " +
                               std::to_string(mostFunctions),
                           "more functions than that are better taken as more steps");
    if (formulas.functions.empty())
        throw InvalidScene("/space/functions", "needs at least two functions",
                           "for example [\"1\", \"tau\"]");
    const EvaluatedFormulas<Quad> functions(formulas);
    const SmoothPanels panels = smoothPanels(
        [&](__float128 tau, std::span<__float128> value, std::span<__float128> derivative) {
            std::vector<Quad> v(functions.size()), d(functions.size());
            functions(Quad(tau), v, d);
            for (std::size_t a = 0; a < v.size(); ++a) {
                value[a] = v[a].backend().value();
                derivative[a] = d[a].backend().value();
            }
        },
        static_cast<int>(functions.size()), exactCells(settings),
        // Some seconds at most, however long the formulas are.
        std::clamp<std::size_t>(2'000'000 / functions.length(), 64, 1024));
    report(panels, formulas);
    const PanelNodes nodes = panelNodes(panels.ends);
    const Sampled<Quad> sampled(functions, nodes, false);
    constexpr double enough = 1e-17, least = 1e-30;
    const Orthonormal<Quad> orthonormal(sampled.vector, enough);
    if (orthonormal.rank() == functions.size())
        return make(cells, panels, nodes, functions, sampled, orthonormal);
    const EvaluatedFormulas<Hundred> longer(formulas);
    const Sampled<Hundred> again(longer, nodes, false);
    const Orthonormal<Hundred> independent(again.vector, least);
    if (independent.rank() < functions.size()) refuseDependent(again, formulas);
    TypedSpace made = make(cells, panels, nodes, longer, again, independent);
    made.usesHundredDigits = true;
    return made;
}

}  // namespace extremal
