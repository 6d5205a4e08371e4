// SPDX-License-Identifier: GPL-3.0-or-later
/// The matrix of the equations of a discretization: a square for every entry that is not zero.
#include <algorithm>
#include <cmath>

#include "engine/family/step_equations.hpp"
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

/// What one equation involves; of a discrete Euler-Lagrange equation also the terms of the action.
std::string supportText(const KktPattern& p) {
    const bool hasMultipliers =
        std::any_of(p.blocks.begin(), p.blocks.end(), [](const UnknownBlock& b) { return b.isMultiplier; });
    if (!hasMultipliers) {
        std::vector<int> inRow(static_cast<std::size_t>(p.size), 0);
        for (const auto& [row, column] : p.action) ++inRow[static_cast<std::size_t>(row)];
        return "equation: up to " + counted(*std::max_element(inRow.begin(), inRow.end()) - 1, "other");
    }
    if (!p.isNodal) return "coefficient: 1 term, " + counted(p.othersInside, "other");
    std::string text = "node: " + counted(p.termsAtNode, "term") + ", " + counted(p.othersAtNode, "other");
    if (p.othersInside > 0) text += " · inside: 1, " + std::to_string(p.othersInside);
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
    if (!reasons.empty()) return "No matrix of equations: " + reasons;
    return context.comparison.isFinished ? "No scheme is switched on" : "";
}

/// The entry of the family of a scheme; null where the scheme is not known.
const StepEquations* entryOf(const SchemeResult& scheme) {
    const Discretization* const plain = scheme.scheme ? scheme.scheme->plain() : nullptr;
    return plain ? &equationsOf(*plain) : nullptr;
}

Figure makeSparsity(const FigureContext& context) {
    Figure figure = startFigure(context, "Matrix of the equations");
    figure.aspect = Aspect::equal;
    const SchemeResult* scheme = schemeOf(context, [](const SchemeResult& s) {
        const KktPattern* p = s.products.find<KktPattern>();
        return p && p->failure.empty();
    });
    if (!scheme) {
        figure.message = reasonsText(context);
        finishFigure(figure, context, "Pattern of the matrix of the equations");
        return figure;
    }
    const KktPattern& p = *scheme->products.find<KktPattern>();
    const StepEquations* const entry = entryOf(*scheme);
    const std::string title = entry ? entry->matrixTitle : "KKT matrix";
    figure.title = title + " of " + scheme->spec.label;
    const std::size_t entries = p.action.size() + p.continuity.size();
    const double filled = 100.0 * static_cast<double>(entries) / (static_cast<double>(p.size) * p.size);
    const std::string counts = std::to_string(p.size) + " unknowns, " + std::to_string(entries) +
                               " entries (" + shortNumber(filled) + " %)";
    const std::string extent =
        entry && entry->extent && context.system
            ? entry->extent(systemOf(context, *scheme), p.elements, p.dimension) + " · "
            : "";
    figure.subtitle = extent + supportText(p) + " · " + counts;
    addCells(figure, *scheme, p.action, p.size, false);
    addCells(figure, *scheme, p.continuity, p.size, true);
    nameBlocks(figure, p, entry ? entry->blockName : nullptr);
    finishFigure(figure, context, "");
    figure.drop<FailureMark>();
    const bool isAbbreviation = title.starts_with("KKT");
    const std::string named =
        isAbbreviation ? title : static_cast<char>(title[0] - 'A' + 'a') + title.substr(1);
    figure.summary = "Pattern of the " + named + " of " + scheme->spec.label + ": " +
                     (extent.empty() ? counted(p.elements, "element") + ", " : extent) + counts +
                     ", bandwidth " + std::to_string(p.bandwidth) + "; " + supportText(p) + ".";
    return figure;
}

}  // namespace

RecipeEntry sparsity() { return {"sparsity", makeSparsity}; }

}  // namespace extremal::recipes
