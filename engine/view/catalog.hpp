// SPDX-License-Identifier: GPL-3.0-or-later
/// The catalogue of views: what each shows, what it needs of a run, and to which systems and schemes it
/// applies. One file of view/views makes one entry.
///
/// A view reads the rows of every scheme, which hold the state and the observables of the scene. What else it
/// needs it names as observable and products, and a run computes just that.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/system.hpp"
#include "engine/view/recipe.hpp"
#include "engine/view/view.hpp"

namespace extremal {

/// What a run can make besides its rows.
enum class Product {
    denseOutput,    ///< the state between the nodes, where steps are few
    denseError,     ///< its distance from the reference
    frames,         ///< samples of a field or wave function
    sections,       ///< states where a column passes zero upwards
    kktPattern,     ///< the structure of the equations of a discretization
    actionDefect,   ///< distance of the discrete Lagrangian from the exact one, by step
    elementClocks,  ///< steps and updates of the elements of asynchronous schemes
    steps,          ///< every step, of schemes whose times are unknowns
    parameterMap,   ///< errors over a grid of a parameter and the step
    starts,         ///< the motions from the starts of a view
    rings,          ///< a ring of starts that moves with the scheme
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
    againstPlace{true, false, false, Across::place}, againstColumn{true, false, false, Across::column};

/// The keys with a place of their own in View, where the view has them; the others are
/// CatalogItem::parameters.
struct ViewKeys {
    bool hasColumns = false;   ///< `x` and `y`
    bool hasObserved = false;  ///< they may be columns of observables as well
    bool hasZeros = false;     ///< `at`
    bool hasNode = false;      ///< `node`
    bool hasScheme = false;    ///< `scheme`: pictures of one scheme
    bool hasStarts = false;    ///< `starts` and `spread`
};

/// How many pictures a view without the key `scheme` makes.
enum class Pictures { one, perDiscretization, perStep };

struct ViewEntry {
    CatalogItem item;
    Recipe recipe;
    Scales scales = {};
    std::string observable = {};  ///< the scene must observe it; empty: the rows are enough
    std::vector<Product> products = {};
    /// The binding parts beside which it means something. By default those of its observable; of a view that
    /// has none, those of problems that are one part alone.
    std::optional<Takes> takes = {};
    /// What the system lacks for it, as "a wave function"; empty text: nothing. Null: every system has the
    /// view. An observable that the system lacks need not be asked about.
    std::string (*missing)(const View&, const System&) = nullptr;
    /// Of views that show discretizations, why one has nothing to show ("a composition"), else empty. Null:
    /// the view shows every scheme.
    std::string (*unsuitable)(const Discretization&) = nullptr;
    ViewKeys keys = {};
    bool (*isOfOneScheme)(const System&) = nullptr;  ///< has `scheme` for these systems besides
    Pictures pictures = Pictures::one;
    /// The state columns that get a plot each (View::y) where the scene names none; null or empty: one plot.
    std::vector<std::string> (*columns)(const System&) = nullptr;
    /// The column along x, of views with Across::column.
    std::string (*xColumn)(const View&, const System&) = nullptr;

    bool isPlot() const { return !std::holds_alternative<NoPlot>(recipe); }
};

/// In alphabetical order of their ids; gathered from the files of view/views.
const std::vector<ViewEntry>& viewEntries();
const ViewEntry* findView(std::string_view id);
/// The same as catalogue items.
const std::vector<CatalogItem>& viewCatalog();

/// What the system lacks for a view of viewEntries(), its observable included; empty: nothing.
std::string missingFor(const View& view, const System& system);
/// The ids of the views that a system has, whatever their keys.
std::vector<std::string> viewsOf(const System& system);

/// The keys of a view; `system` is null where the model is not known.
ViewKeys keysOf(const std::string& view, const System* system);

/// Id, title, description and keys of a view.
CatalogItem viewItem(std::string id, std::string title, std::string description,
                     std::vector<FieldInfo> keys = {});

}  // namespace extremal
