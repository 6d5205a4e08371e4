/// A view as a scene asks for it: which one, and what it is to show. What there is to ask for is in
/// view/catalog.hpp.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/number.hpp"
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

struct View {
    std::string id;                   ///< "energy", "phase", ...
    std::string x, y;                 ///< columns of a phase portrait or trajectory; empty: default
    std::string at = {};              ///< column whose zeros make a section; empty: the first coordinate
    std::string scheme = {};          ///< label, for pictures of one scheme; empty: of each
    std::optional<Number> node = {};  ///< of a shape function; empty: the one in the middle
    std::optional<ViewRange> xRange = {}, yRange = {};
    ViewCurve curve = {};
    Settings keys = {};  ///< of views with keys of their own (CatalogItem::parameters); type empty
    bool operator==(const View&) const = default;
};

}  // namespace extremal
