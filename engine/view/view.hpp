// SPDX-License-Identifier: GPL-3.0-or-later
/// A view as a scene asks for it: which one, and what it is to show. What there is to ask for is in
/// view/catalog.hpp.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/algebra/number.hpp"
#include "engine/core/settings.hpp"

namespace extremal {

/// The part of an axis that a plot shows at first.
struct ViewRange {
    Number low, high;
    bool operator==(const ViewRange&) const = default;
};

/// An expression in the variable along the x axis, drawn for comparison.
struct ViewCurve {
    std::string expression;                              ///< empty: none
    std::vector<std::pair<std::string, double>> values;  ///< of the model's parameters in it
    bool operator==(const ViewCurve&) const = default;
};

/// Starts besides that of the scene, in the plane of the view's two columns: of a section, where it passes
/// upwards with the energy of the scene's start; of a phase portrait, with the other columns of that start.
struct ViewStarts {
    static constexpr int most = 2000;  ///< of points, and of `spread`
    std::vector<std::pair<Number, Number>> points;
    int spread = 0;  ///< that many more, spread evenly
    bool isEmpty() const { return points.empty() && spread == 0; }
    bool operator==(const ViewStarts&) const = default;
};

/// The size of a view's card in the window, in pixels of 96 to the inch; 0: what the window has room for. The
/// cards of a row share its width in the ratio of theirs.
struct CardSize {
    static constexpr int least = 110, most = 4000;
    int width = 0, height = 0;
    bool operator==(const CardSize&) const = default;
};

/// How the cards of the window share its room.
enum class PageLayout {
    automatic,  ///< as many columns as the window has room for
    oneColumn,
    twoColumns,
    threeColumns,
    plotsOnly,  ///< as automatic, without the stage
};

struct View {
    std::string id;                   ///< "energy", "phase", ...
    std::string x, y;                 ///< columns of a phase portrait or trajectory; empty: default
    std::string at = {};              ///< column whose zeros make a section; empty: the first coordinate
    std::string scheme = {};          ///< label, for pictures of one scheme; empty: of each
    std::optional<Number> node = {};  ///< of a shape function; empty: the one in the middle
    std::optional<ViewRange> xRange = {}, yRange = {};
    std::optional<bool> isLog = {};  ///< the axis y; empty: as the view has it
    CardSize size = {};
    ViewCurve curve = {};
    ViewStarts starts = {};
    Settings keys = {};  ///< of views with keys of their own (CatalogItem::parameters); type empty
    bool operator==(const View&) const = default;
};

}  // namespace extremal
