// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/tableau_page.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/text/text.hpp"
#include "engine/tableau/order_conditions.hpp"

namespace extremal {
namespace {

constexpr int digits = 30, mostStages = 8, mostOrder = 6;

/// Formulas of a step with many stages must fit on a line; the listing has all digits.
int digitsInFormulas(Eigen::Index stages) { return stages > 4 ? 6 : 12; }

using Matrix = Tableau::Matrix;
using Vector = Tableau::Vector;

bool isZero(const Quad& x, double known) { return abs(x) <= known; }

/// How many decimals are known: fewer where entries come from printed digits.
int digitsOf(const Tableau& t) { return t.known > 1e-20 ? 15 : digits; }

std::string texNumber(const Quad& x, int decimals, double known) {
    const std::string text = numberText(abs(x), decimals, known);
    const auto slash = text.find('/');
    if (slash == std::string::npos) return text;
    return "\\tfrac{" + text.substr(0, slash) + "}{" + text.substr(slash + 1) + "}";
}

/// start + h (sum of coefficients times names).
WrittenFormula combination(const std::string& left, const std::string& start, const auto& row,
                           const std::string& name, double known) {
    WrittenFormula f{left + " = " + start, left + " = " + start};
    std::string plain, tex;
    const int decimals = digitsInFormulas(row.size());
    Eigen::Index terms = 0;
    for (Eigen::Index j = 0; j < row.size(); ++j) {
        const Quad& a = row(j);
        if (isZero(a, known)) continue;
        const bool isOne = isZero(abs(a) - 1, known);
        const std::string number = numberText(abs(a), decimals, known);
        const std::string of = name + "_" + std::to_string(j + 1),
                          ofTex = name + "_{" + std::to_string(j + 1) + "}";
        const char* const sign = a < 0 ? (terms > 0 ? " − " : "−") : (terms > 0 ? " + " : "");
        const char* const signTex = a < 0 ? " - " : (terms > 0 ? " + " : "");
        plain.append(sign).append(isOne ? "" : number + " ").append(of);
        tex.append(signTex).append(isOne ? "" : texNumber(a, decimals, known) + "\\, ").append(ofTex);
        ++terms;
    }
    if (terms == 0) return f;
    const bool hasBrackets = terms > 1 || plain.starts_with("−");
    f.plain += " + h " + (hasBrackets ? "(" + plain + ")" : plain);
    f.tex += " + h " + (hasBrackets ? "\\bigl(" + tex + "\\bigr)" : "\\, " + tex);
    return f;
}

std::string scopeText(const Tableau& t) {
    switch (t.scope) {
        case TableauScope::any:
            return "every Hamiltonian H(q, p)";
        case TableauScope::separable:
            return "H = T(p) + V(q)";
        case TableauScope::quadraticKinetic:
            return "H = p·M⁻¹p/2 + V(q) with a constant mass M";
    }
    return {};
}

void addPlainStep(const Tableau& t, Document& page) {
    Document::Formulas f;
    const auto state = [&](int i) { return "x_" + std::to_string(i); };
    for (int i = 0; i < t.velocities(); ++i) {
        const std::string stage = "X_" + std::to_string(i + 1);
        WrittenFormula line = combination(stage, state(0), t.A.row(i), "K", t.known);
        line.plain += ",  K_" + std::to_string(i + 1) + " = f(" + stage + ")";
        line.tex += ", \\quad K_{" + std::to_string(i + 1) + "} = f(" + stage + ")";
        f.lines.push_back(std::move(line));
    }
    f.lines.push_back(combination(state(1), state(0), t.b.transpose().eval(), "K", t.known));
    page.blocks.emplace_back(std::move(f));
}

void addPartitionedStep(const Tableau& t, Document& page) {
    Document::Formulas f;
    for (const auto& [isOfV, i] : stageOrder(t)) {
        const std::string n = std::to_string(i + 1);
        WrittenFormula line = isOfV ? combination("P_" + n, "p_0", t.Ahat.row(i), "F", t.known)
                                    : combination("Q_" + n, "q_0", t.A.row(i), "V", t.known);
        line.plain += isOfV ? ",  V_" + n + " = ∂H/∂p" : ",  F_" + n + " = −∂H/∂q";
        line.tex += isOfV ? ", \\quad V_{" + n + "} = \\partial H / \\partial p"
                          : ", \\quad F_{" + n + "} = -\\partial H / \\partial q";
        f.lines.push_back(std::move(line));
    }
    f.lines.push_back(combination("q_1", "q_0", t.b.transpose().eval(), "V", t.known));
    f.lines.push_back(combination("p_1", "p_0", t.bHat.transpose().eval(), "F", t.known));
    page.blocks.emplace_back(std::move(f));
}

void listMatrix(const char* name, const Matrix& A, int decimals, double known, Document::Listing& listing) {
    for (Eigen::Index i = 0; i < A.rows(); ++i)
        for (Eigen::Index j = 0; j < A.cols(); ++j) {
            if (isZero(A(i, j), known)) continue;
            listing.lines.push_back(std::string(name) + "[" + std::to_string(i + 1) + "," +
                                    std::to_string(j + 1) + "] = " + numberText(A(i, j), decimals, known));
        }
}

void listVector(const char* name, const Vector& b, int decimals, double known, Document::Listing& listing) {
    for (Eigen::Index i = 0; i < b.size(); ++i)
        listing.lines.push_back(std::string(name) + "[" + std::to_string(i + 1) +
                                "] = " + numberText(isZero(b(i), known) ? Quad(0) : b(i), decimals, known));
}

std::string small(const Quad& x) { return formatNumber(static_cast<double>(abs(x)), 2); }

/// 1 + z/2 + z^2/12.
WrittenFormula polynomial(const std::vector<Quad>& c, const std::string& z, const std::string& zTex,
                          int power, double known) {
    WrittenFormula f;
    const int decimals = digitsInFormulas(static_cast<Eigen::Index>(c.size()) - 1);
    for (std::size_t k = 0; k < c.size(); ++k) {
        if (isZero(c[k], 1e-28)) continue;
        const int n = power * static_cast<int>(k);
        const bool isOne = n > 0 && isZero(abs(c[k]) - 1, known);
        const std::string sign = c[k] < 0 ? (f.plain.empty() ? "−" : " − ") : (f.plain.empty() ? "" : " + ");
        const std::string signTex = c[k] < 0 ? "-" : (f.tex.empty() ? "" : "+");
        const std::string exponent = n > 1 ? "^" + std::to_string(n) : "";
        const std::string number = isOne ? "" : numberText(abs(c[k]), decimals, known);
        f.plain += sign + number + (n > 0 ? (isOne ? "" : " ") + z + exponent : "");
        f.tex += signTex + (isOne ? "" : texNumber(c[k], decimals, known)) +
                 (n > 0 ? zTex + (n > 1 ? "^{" + std::to_string(n) + "}" : "") : "");
    }
    return f;
}

WrittenFormula quotient(const std::string& left, const std::string& leftTex, const RationalFunction& R,
                        const std::string& z, const std::string& zTex, int power, double known) {
    const WrittenFormula over = polynomial(R.numerator, z, zTex, power, known),
                         under = polynomial(R.denominator, z, zTex, power, known);
    if (under.plain == "1") return {left + " = " + over.plain, leftTex + " = " + over.tex};
    return {left + " = (" + over.plain + ") / (" + under.plain + ")",
            leftTex + " = \\frac{" + over.tex + "}{" + under.tex + "}"};
}

const char* treesText(TreeKind kind) {
    switch (kind) {
        case TreeKind::plain:
            return "x′ = f(x), trees of one kind";
        case TreeKind::all:
            return "q′ = f(q, p), p′ = g(q, p), trees of both kinds of nodes";
        case TreeKind::separable:
            return "q′ = f(p), p′ = g(q), nodes of both kinds in turn";
        case TreeKind::quadraticKinetic:
            return "q′ = f(p), p′ = g(q), f linear: Nyström's trees";
    }
    return "";
}

}  // namespace

void addStep(const Tableau& t, Document& page) {
    page.blocks.emplace_back(Document::Heading{"The step"});
    page.blocks.emplace_back(Document::Paragraph{
        "With the unknowns inside the step eliminated it is " +
        std::string(t.isPlain() ? "a Runge-Kutta method" : "a partitioned Runge-Kutta method") + " for " +
        scopeText(t) + (t.isExplicit() ? ", explicit" : ", implicit") + "."});
    if (std::max(t.velocities(), t.forces()) > mostStages) {
        page.blocks.emplace_back(Document::Formulas{
            {{"Q_i = q_0 + h Σ_j A_ij V_j,  F_i = −∂H/∂q(Q_i, P_i)",
              "Q_i = q_0 + h \\sum_j A_{ij} V_j, \\qquad F_i = -\\partial H / \\partial q(Q_i, P_i)"},
             {"P_j = p_0 + h Σ_i Â_ji F_i,  V_j = ∂H/∂p(Q_j, P_j)",
              "P_j = p_0 + h \\sum_i \\hat A_{ji} F_i, \\qquad V_j = \\partial H / \\partial p(Q_j, P_j)"}}});
        return;
    }
    if (t.isPlain())
        addPlainStep(t, page);
    else
        addPartitionedStep(t, page);
}

void addCoefficients(const Tableau& t, Document& page) {
    page.blocks.emplace_back(Document::Heading{"Coefficients"});
    const int decimals = digitsOf(t);
    page.blocks.emplace_back(
        Document::Paragraph{"Fractions are exact; other numbers have " + std::to_string(decimals) +
                            " decimals. Entries that are left out " +
                            (t.isPlain() ? "are 0." : "are 0; Ahat and bhat are those of p.")});
    Document::Listing listing;
    listVector("c", t.c, decimals, t.known, listing);
    if (!t.isPlain() && t.scope != TableauScope::quadraticKinetic && t.scope != TableauScope::any)
        listVector("chat", t.cHat, decimals, t.known, listing);
    listVector("b", t.b, decimals, t.known, listing);
    if (!t.isPlain() && (t.b.size() != t.bHat.size() || (t.b - t.bHat).cwiseAbs().maxCoeff() > t.known))
        listVector("bhat", t.bHat, decimals, t.known, listing);
    listMatrix("A", t.A, decimals, t.known, listing);
    if (!t.isPlain()) listMatrix("Ahat", t.Ahat, decimals, t.known, listing);
    page.blocks.emplace_back(std::move(listing));
}

void addOrderConditions(const Tableau& t, Document& page) {
    const TreeKind kind = treesFor(t);
    std::vector<OrderCondition> all = orderConditions(t, kind, mostOrder);
    page.blocks.emplace_back(Document::Heading{"Order conditions"});
    const int order = orderOf(all, t.known);
    page.blocks.emplace_back(Document::Paragraph{
        "Of " + std::string(treesText(kind)) + ": " + std::to_string(all.size()) +
        " conditions up to order " + std::to_string(mostOrder) + ". " +
        (order >= mostOrder ? "All hold." : "Those up to order " + std::to_string(order) + " hold.")});
    Document::Table byOrder{{"order", "conditions", "that hold", "largest residual", "of the tree"}, {}};
    for (int k = 1; k <= mostOrder; ++k) {
        int count = 0, held = 0;
        const OrderCondition* worst = nullptr;
        for (const OrderCondition& c : all) {
            if (c.order != k) continue;
            ++count;
            held += abs(c.residual) <= 1e3 * t.known;
            if (!worst || abs(c.residual) > abs(worst->residual)) worst = &c;
        }
        byOrder.rows.push_back({std::to_string(k), std::to_string(count), std::to_string(held),
                                small(worst->residual), worst->tree});
    }
    page.blocks.emplace_back(std::move(byOrder));
    if (kind == TreeKind::separable) {
        const auto nystrom = orderConditions(t, TreeKind::quadraticKinetic, mostOrder);
        if (const int higher = orderOf(nystrom, t.known); higher > order)
            page.blocks.emplace_back(
                Document::Paragraph{"Where kinetic energy is quadratic with a constant mass fewer conditions "
                                    "remain, and the order is " +
                                    std::to_string(higher) + (higher == mostOrder ? " or more." : ".")});
    }
    constexpr std::size_t mostRows = 80;
    if (all.size() > mostRows) return;
    Document::Table trees{{"tree", "order", "sum", "residual"}, {}};
    for (const OrderCondition& c : all)
        trees.rows.push_back({c.tree, std::to_string(c.order),
                              c.gamma == 1 ? "1" : "1/" + std::to_string(c.gamma), small(c.residual)});
    page.blocks.emplace_back(std::move(trees));
}

void addStructure(const Tableau& t, Document& page) {
    page.blocks.emplace_back(Document::Heading{"Symplecticity and symmetry of the coefficients"});
    const bool isPlain = t.isPlain();
    const Quad symplectic = symplecticityDefect(t), symmetric = symmetryDefect(t);
    const auto verdict = [&](const Quad& defect) { return defect <= 100 * t.known ? "yes" : "no"; };
    Document::Table table{{"", "largest defect", ""}, {}};
    table.rows.push_back({isPlain ? "symplectic: b_i a_ij + b_j a_ji − b_i b_j = 0"
                                  : "symplectic: bhat_i A_ij + b_j Ahat_ji − bhat_i b_j = 0",
                          small(symplectic), verdict(symplectic)});
    table.rows.push_back(
        {"symmetric: a_ij + a_{s+1−i, s+1−j} − b_j = 0", small(symmetric), verdict(symmetric)});
    page.blocks.emplace_back(std::move(table));
    if (t.velocities() != t.forces()) return;
    const SimplifyingAssumptions k = simplifyingAssumptions(t);
    page.blocks.emplace_back(Document::Paragraph{"Simplifying assumptions: B(" + std::to_string(k.B) +
                                                 "), C(" + std::to_string(k.C) + "), D(" +
                                                 std::to_string(k.D) + ")."});
}

void addStabilityFunction(const Tableau& t, Document& page) {
    if (std::max(t.velocities(), t.forces()) > 2 * mostStages) return;
    Document::Formulas f;
    if (t.isPlain()) f.lines.push_back(quotient("R(z)", "R(z)", stabilityFunction(t), "z", "z", 1, t.known));
    f.lines.push_back(quotient("½ trace(h ω = z)", "\\tfrac12 \\operatorname{trace}(h \\omega = z)",
                               oscillatorTrace(t), "z", "z", 2, t.known));
    page.blocks.emplace_back(std::move(f));
}

}  // namespace extremal
