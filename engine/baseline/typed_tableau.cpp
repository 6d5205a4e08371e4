// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/typed_tableau.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/memo_cache.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/exact_number.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"
#include "engine/integrator/oscillator_step.hpp"
#include "engine/integrator/stability.hpp"
#include "engine/tableau/order_conditions.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostStages = 32;
constexpr double exact = 1e-30, rounded = 1e-16;
/// Defects below this were meant to be zero.
constexpr double meant = 1e-5;

/// The value of a key that is there; null else.
const Value* valueAt(const Settings& settings, const char* key) {
    const Value* const value = settings.find(key);
    return value && !value->isNull() ? value : nullptr;
}

/// Entries with the precision to which they are known.
struct Reader {
    double known = exact;

    Quad number(const Value& entry, const std::string& pointer) {
        // Not 0.5 or 0.125, but digits of something.
        if (entry.isNumber() && formatNumber(entry.asNumber()).size() > 8) known = rounded;
        return exactNumber(entry, pointer, "\"1/6\"");
    }
    std::vector<Quad> numbers(const Settings& settings, const char* key) {
        const std::string pointer = std::string("/baseline/") + key;
        const Value* const given = settings.find(key);
        if (!given || !given->isArray() || given->asArray().empty())
            throw InvalidScene(pointer, "must be an array of numbers or expressions",
                               "for example [\"1/2\", \"1/2\"]");
        if (given->asArray().size() > mostStages)
            throw InvalidScene(pointer, "must have at most " + std::to_string(mostStages) + " entries, got " +
                                            std::to_string(given->asArray().size()));
        std::vector<Quad> all;
        for (const Value& entry : given->asArray())
            all.push_back(number(entry, pointer + "/" + std::to_string(all.size())));
        return all;
    }
    Tableau::Matrix square(const Settings& settings, const char* key, std::size_t stages) {
        const std::string pointer = std::string("/baseline/") + key;
        const Value* const given = settings.find(key);
        if (!given || !given->isArray())
            throw InvalidScene(pointer, "must be an array of rows", "for example [[], [\"1/2\"]]");
        if (given->asArray().size() != stages)
            throw InvalidScene(pointer,
                               "must have as many rows as there are weights, " + std::to_string(stages) +
                                   ", got " + std::to_string(given->asArray().size()),
                               "one row per stage; that of an explicit first stage is []");
        const auto n = static_cast<Eigen::Index>(stages);
        Tableau::Matrix A = Tableau::Matrix::Zero(n, n);
        for (std::size_t i = 0; i < stages; ++i) {
            const std::string row = pointer + "/" + std::to_string(i);
            const Value& entries = given->asArray()[i];
            if (!entries.isArray()) throw InvalidScene(row, "must be an array of numbers or expressions");
            if (entries.asArray().size() > stages)
                throw InvalidScene(row, "must have at most " + std::to_string(stages) + " entries, got " +
                                            std::to_string(entries.asArray().size()));
            for (std::size_t j = 0; j < entries.asArray().size(); ++j)
                A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                    number(entries.asArray()[j], row + "/" + std::to_string(j));
        }
        return A;
    }
};

Tableau::Vector vectorOf(const std::vector<Quad>& v) {
    return Eigen::Map<const Tableau::Vector>(v.data(), static_cast<Eigen::Index>(v.size()));
}

void checkSum(const std::vector<Quad>& b, const char* key, double known) {
    Quad sum(0);
    for (const Quad& x : b) sum += x;
    if (abs(sum - 1) <= std::max(1e3 * known, meant)) return;
    throw InvalidScene(std::string("/baseline/") + key,
                       "must sum to 1, as the step has to cover its time, and sum to " +
                           formatNumber(static_cast<double>(sum), 10),
                       "look for a missing or misprinted coefficient");
}

/// Spectral radius of the step on q' = z p, p' = -z q.
double growth(const Tableau& t, double z) {
    const Eigen::Index n = t.velocities(), m = t.forces();
    using Matrix = Eigen::MatrixXd;
    // P = p_0 - z Ahat Q, Q = q_0 + z A P, with V = z P and F = -z Q.
    Matrix system = Matrix::Identity(n + m, n + m), right = Matrix::Zero(n + m, 2);
    system.topRightCorner(n, m) = z * t.Ahat.cast<double>();
    system.bottomLeftCorner(m, n) = -z * t.A.cast<double>();
    right.col(1).head(n).setOnes();
    right.col(0).tail(m).setOnes();
    const Matrix stages = dense::solve<double>(system, right);
    Eigen::Matrix2d M = Eigen::Matrix2d::Identity();
    M.row(0) += z * t.b.cast<double>().transpose() * stages.topRows(n);
    M.row(1) -= z * t.bHat.cast<double>().transpose() * stages.bottomRows(m);
    const double half = M.trace() / 2, determinant = M.determinant(), root = half * half - determinant;
    return root > 0 ? std::abs(half) + std::sqrt(root) : std::sqrt(std::max(0.0, determinant));
}

int mostOrderOf(TreeKind kind) { return kind == TreeKind::all ? 6 : 8; }
TreeKind countedTrees(const Tableau& t) {
    return t.scope == TableauScope::separable ? TreeKind::quadraticKinetic : treesFor(t);
}

TypedTableau examined(Tableau table) {
    TypedTableau made;
    made.tableau = std::make_shared<const Tableau>(std::move(table));
    const Tableau& t = *made.tableau;
    const TreeKind kind = countedTrees(t);
    const int most = mostOrderOf(kind);
    made.conditions = orderConditions(t, kind, most);
    Claims& claims = made.claims;
    claims.order = orderOf(made.conditions, t.known);
    if (claims.order == most && kind == TreeKind::plain) {
        const SimplifyingAssumptions k = simplifyingAssumptions(t);
        claims.order = std::max(most, std::min({k.B, k.C + k.D + 1, 2 * k.C + 2}));
    }
    const double enough = 1e3 * t.known;
    claims.isSymmetric = symmetryDefect(t) <= enough;
    claims.isSymplectic = symplecticityDefect(t) <= enough;
    if (claims.isSymplectic) claims.conserves = {"momentum"};
    if (claims.isSymplectic && t.isPlain()) claims.conserves.push_back("quadratic invariants");
    constexpr double noGrowth = 1e-12;
    made.stabilityLimit =
        claims.isSymplectic
            ? firstEdge(OscillatorStep(made.tableau).intervals())
            : firstInstability([&](double z) { return growth(t, z) <= 1 + noGrowth; }).limit();
    return made;
}

TypedTableau readRungeKutta(const Settings& settings) {
    Reader reader;
    const std::vector<Quad> b = reader.numbers(settings, "b");
    const Tableau::Matrix A = reader.square(settings, "a", b.size());
    const bool hasHat = valueAt(settings, "a_hat") != nullptr,
               hasWeights = valueAt(settings, "b_hat") != nullptr;
    if (hasWeights && !hasHat)
        throw InvalidScene("/baseline/b_hat", "requires a_hat", "add a_hat, the table of p");
    const std::vector<Quad> bHat = hasWeights ? reader.numbers(settings, "b_hat") : b;
    if (bHat.size() != b.size())
        throw InvalidScene("/baseline/b_hat", "must have as many weights as b, " + std::to_string(b.size()) +
                                                  ", got " + std::to_string(bHat.size()));
    Tableau t = hasHat ? partitionedTableau(A, reader.square(settings, "a_hat", b.size()), vectorOf(b),
                                            vectorOf(bHat), TableauScope::any)
                       : plainTableau(A, vectorOf(b));
    if (valueAt(settings, "c")) {
        const std::vector<Quad> c = reader.numbers(settings, "c");
        if (c.size() != b.size())
            throw InvalidScene("/baseline/c", "must have as many nodes as there are weights, " +
                                                  std::to_string(b.size()) + ", got " +
                                                  std::to_string(c.size()));
        t.c = vectorOf(c);
        if (!hasHat) t.cHat = t.c;
    }
    t.known = reader.known;
    checkSum(b, "b", t.known);
    checkSum(bHat, "b_hat", t.known);
    return examined(std::move(t));
}

TypedTableau readSplitting(const Settings& settings) {
    Reader reader;
    const std::vector<Quad> kicks = reader.numbers(settings, "kicks"),
                            drifts = reader.numbers(settings, "drifts");
    const std::size_t m = kicks.size(), n = drifts.size();
    if (m > n + 1 || n > m + 1)
        throw InvalidScene(m > n ? "/baseline/drifts" : "/baseline/kicks",
                           "must alternate with the others: " + std::to_string(m) + " kicks and " +
                               std::to_string(n) + " drifts do not",
                           "as many of both, or one more of those that begin and end the step");
    checkSum(kicks, "kicks", reader.known);
    checkSum(drifts, "drifts", reader.known);
    const bool isKickFirst = m != n ? m > n : settings.text("first") == "kick";
    Splitting splitting;
    std::vector<TableauFlow> flows;
    for (std::size_t i = 0; i < m + n; ++i) {
        const bool isKick = (i % 2 == 0) == isKickFirst;
        const Quad& fraction = (isKick ? kicks : drifts)[i / 2];
        flows.push_back({isKick, fraction});
        splitting.stages.push_back({isKick, static_cast<double>(fraction)});
    }
    Tableau t = splittingTableau(flows);
    t.known = reader.known;
    TypedTableau made = examined(std::move(t));
    splitting.order = made.claims.order;
    splitting.isNystrom =
        splitting.order > orderOf(orderConditions(*made.tableau, TreeKind::separable, 8), reader.known);
    made.splitting = std::move(splitting);
    return made;
}

/// Conditions of the next order that almost hold.
void warnOfDigits(const TypedTableau& typed, const char* key, Findings& findings) {
    const int order = typed.claims.order;
    int nearly = mostOrderOf(countedTrees(*typed.tableau));
    for (const OrderCondition& c : typed.conditions)
        if (abs(c.residual) > meant) nearly = std::min(nearly, c.order - 1);
    if (nearly <= order) return;
    const OrderCondition* worst = nullptr;
    for (const OrderCondition& c : typed.conditions)
        if (c.order <= nearly && (!worst || abs(c.residual) > abs(worst->residual))) worst = &c;
    findings.warning(std::string("/baseline/") + key,
                     "has order " + std::to_string(order) + ", and nearly " + std::to_string(nearly) +
                         ": the condition of the tree " + worst->tree + " holds to " +
                         formatNumber(static_cast<double>(abs(worst->residual)), 2) + " only",
                     "more digits, or fractions such as \"1/6\"", {}, "order-conditions");
}

using Remembered = MemoCache<Settings, std::shared_ptr<const TypedTableau>>;
constexpr std::size_t mostRemembered = 64;

}  // namespace

std::shared_ptr<const TypedTableau> typedRungeKutta(const Settings& settings) {
    static Remembered known(mostRemembered);
    return known.get(settings,
                     [&] { return std::make_shared<const TypedTableau>(readRungeKutta(settings)); });
}

std::shared_ptr<const TypedTableau> typedSplitting(const Settings& settings) {
    static Remembered known(mostRemembered);
    return known.get(settings, [&] { return std::make_shared<const TypedTableau>(readSplitting(settings)); });
}

void examine(const Settings& settings, bool isSplitting, Findings& findings) {
    try {
        const auto typed = isSplitting ? typedSplitting(settings) : typedRungeKutta(settings);
        const Tableau& t = *typed->tableau;
        const char* const key = isSplitting ? "kicks" : "a";
        if (typed->claims.order < 1)
            findings.error(isSplitting ? "/baseline/kicks" : "/baseline/b",
                           "has order 0: the sum is not 1 to round-off",
                           "more digits, or fractions such as \"1/6\"", "order-conditions");
        warnOfDigits(*typed, key, findings);
        if (isSplitting || !valueAt(settings, "c")) return;
        const Tableau::Vector sums = t.Ahat.rowwise().sum();
        for (Eigen::Index i = 0; i < sums.size(); ++i)
            if (abs(sums(i) - t.c(i)) > 1e3 * t.known)
                findings.warning("/baseline/c/" + std::to_string(i),
                                 "is " + formatNumber(static_cast<double>(t.c(i)), 10) +
                                     ", and its row sums to " +
                                     formatNumber(static_cast<double>(sums(i)), 10) +
                                     ": where the Lagrangian depends on time the order is 1",
                                 "leave c out: nodes are the sums of the rows", {}, "order-conditions");
    } catch (const InvalidScene& e) {
        findings.errors.insert(findings.errors.end(), e.problems().begin(), e.problems().end());
    }
}

}  // namespace extremal
