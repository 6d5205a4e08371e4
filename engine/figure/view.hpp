/// A view: one way to look at a comparison. One file of figure/views makes one entry; the catalogue is
/// gathered from the folder. What the files share is in figure/build.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/figure/figure.hpp"

namespace extremal {

struct FigureContext {
    const Comparison& comparison;
    const View& view;
    const System* system = nullptr;  ///< null: unknown model; titles then come from the columns
};

/// What stands along the x axis of a view.
enum class Across { other, time, place, column };

/// The axes of a view whatever the scene.
struct Scales {
    bool exist = true;  ///< numbers along both axes
    bool isXLog = false, isYLog = false;
    Across across = Across::other;
};
inline constexpr Scales noScales{false}, logScales{true, true, true},
    againstTime{true, false, false, Across::time}, logAgainstTime{true, false, true, Across::time},
    againstPlace{true, false, false, Across::place};

struct ViewEntry {
    CatalogItem item;
    std::string observable;  ///< the scene must observe it; empty: the state is enough
    Figure (*make)(const FigureContext&) = nullptr;  ///< null: no plot (the stage)
    /// The state columns that get a plot each (View::y) where the scene names none; null or empty: one plot.
    std::vector<std::string> (*columns)(const System&) = nullptr;
    Scales scales = {};
    /// The column along x, of views with Across::column.
    std::string (*xColumn)(const View&, const System&) = nullptr;
};

/// In alphabetical order of their ids.
const std::vector<ViewEntry>& viewEntries();
const ViewEntry* findView(std::string_view id);

}  // namespace extremal
