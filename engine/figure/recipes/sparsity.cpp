// SPDX-License-Identifier: GPL-3.0-or-later
/// The matrix of the equations of a discretization, nothing condensed: a square for every entry that is not
/// zero.
#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/figure/kkt_axes.hpp"

namespace extremal::recipes {
namespace {

/// Rows grow downwards, as in print.
void addCells(Figure& figure, const SchemeResult& scheme, const KktPattern::Entries& entries, int size,
              bool isHollow) {
    Series s;
    s.label = scheme.spec.label;
    s.style = scheme.style;
    s.kind = SeriesKind::cells;
    if (isHollow) s.tone = Tone::pale;
    for (const auto& [row, column] : entries) {
        s.x.push_back(column);
        s.y.push_back(size - 1 - row);
    }
    figure.add(std::move(s));
}

std::string counted(int n, const char* one) { return std::to_string(n) + " " + one + (n == 1 ? "" : "s"); }

/// What a discrete Euler-Lagrange equation involves.
std::string supportText(const KktPattern& p) {
    if (!p.isNodal) return "coefficient: 1 term, " + counted(p.othersInside, "other");
    std::string text = "node: " + counted(p.termsAtNode, "term") + ", " + counted(p.othersAtNode, "other");
    if (p.functions > 2) text += " · inside: 1, " + std::to_string(p.othersInside);
    return text;
}

/// Why there is no picture, for every scheme that could have been meant.
std::string reasonsText(const FigureContext& context) {
    std::string reasons;
    for (const auto& scheme : context.comparison.schemes) {
        const bool isMeant = context.view.scheme.empty() || scheme->spec.label == context.view.scheme;
        if (const KktPattern* p = scheme->products.find<KktPattern>(); isMeant && p)
            reasons += (reasons.empty() ? "" : "; ") + scheme->spec.label + ": " + p->failure;
    }
    if (!reasons.empty()) return "No KKT matrix: " + reasons;
    return context.comparison.isFinished ? "No scheme is switched on" : "";
}

Figure makeSparsity(const FigureContext& context) {
    Figure figure = startFigure(context, "KKT matrix");
    figure.aspect = Aspect::equal;
    const SchemeResult* scheme = schemeOf(context, [](const SchemeResult& s) {
        const KktPattern* p = s.products.find<KktPattern>();
        return p && p->failure.empty();
    });
    if (!scheme) {
        figure.message = reasonsText(context);
        finishFigure(figure, context, "Pattern of the KKT matrix");
        return figure;
    }
    const KktPattern& p = *scheme->products.find<KktPattern>();
    figure.title = "KKT matrix of " + scheme->spec.label;
    const std::size_t entries = p.action.size() + p.continuity.size();
    const double filled = 100.0 * static_cast<double>(entries) / (static_cast<double>(p.size) * p.size);
    const std::string counts = std::to_string(p.size) + " unknowns, " + std::to_string(entries) +
                               " entries (" + shortNumber(filled) + " %)";
    figure.subtitle = supportText(p) + " · " + counts;
    addCells(figure, *scheme, p.action, p.size, false);
    addCells(figure, *scheme, p.continuity, p.size, true);
    nameBlocks(figure, p);
    finishFigure(figure, context, "");
    figure.drop<FailureMark>();
    figure.summary = "Pattern of the KKT matrix of " + scheme->spec.label + ": " +
                     counted(p.elements, "element") + ", " + counts + ", bandwidth " +
                     std::to_string(p.bandwidth) + "; " + supportText(p) + ".";
    return figure;
}

}  // namespace

RecipeEntry sparsity() { return {"sparsity", makeSparsity}; }

}  // namespace extremal::recipes
