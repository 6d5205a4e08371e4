// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run makes besides the rows of its schemes, because a view or the export asks for it: each product
/// by its type, at most one of a type. What is not asked for is not computed (neededProducts).
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/element_clocks.hpp"
#include "engine/run/action_defect.hpp"
#include "engine/run/cases/parameter_map.hpp"
#include "engine/run/cases/start_sets.hpp"
#include "engine/run/kkt_pattern.hpp"
#include "engine/run/march/found_events.hpp"
#include "engine/run/march/found_impacts.hpp"
#include "engine/run/march/step_records.hpp"
#include "engine/scene/scene.hpp"
#include "engine/trajectory/frames.hpp"
#include "engine/trajectory/trajectory.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {

struct ResolvedScene;

/// t and the state of a run of up to some thousand steps, several times in each step or in each curved one;
/// with Product::denseError the column "error" as well.
struct DenseOutput {
    Trajectory points;
    void checkpoint(Archive& archive) { archive(points); }
};

/// Samples of a field at rows, all of them while they fit into their memory.
struct FieldFrames {
    std::vector<Frame> all;
    void checkpoint(Archive& archive) { archive(all); }
};

/// States where a column passes zero upwards, found on the dense output: one for each view that needs them.
struct Sections {
    struct Section {
        std::string column;
        Trajectory events;  ///< t and the state
    };
    std::vector<Section> all;
    void checkpoint(Archive& archive) {
        for (Section& section : all) archive(section.events);
    }
};

/// A ring of starts that moves with the scheme (observe/moving_ring.hpp), at rows: of each its points in the
/// plane, and behind them the integral over it.
struct MovedRings {
    std::vector<Frame> frames;
    void checkpoint(Archive& archive) { archive(frames); }
};

/// Of a comparison: one map per scheme that has a step.
struct ParameterMaps {
    std::vector<std::shared_ptr<const ParameterMap>> all;
};

class Products {
public:
    /// Null where it was not made.
    template <class P>
    const P* find() const {
        for (const Value& each : all_)
            if (const P* product = std::get_if<P>(&each)) return product;
        return nullptr;
    }
    /// The product, empty where it was not there.
    template <class P>
    P& make() {
        for (Value& each : all_)
            if (P* product = std::get_if<P>(&each)) return *product;
        return std::get<P>(all_.emplace_back(P{}));
    }
    template <class P>
    void drop() {
        std::erase_if(all_, [](const Value& each) { return std::holds_alternative<P>(each); });
    }
    std::size_t size() const { return all_.size(); }

    /// Those that grow along a march.
    void checkpoint(Archive& archive) {
        exchange<DenseOutput>(archive);
        exchange<FieldFrames>(archive);
        exchange<MovedRings>(archive);
        exchange<Sections>(archive);
        exchange<StepRecords>(archive);
        exchange<FoundEvents>(archive);
        exchange<FoundImpacts>(archive);
    }

private:
    template <class P>
    void exchange(Archive& archive) {
        bool isThere = find<P>() != nullptr;
        archive(isThere);
        if (isThere)
            archive(make<P>());
        else
            drop<P>();
    }

    using Value = std::variant<DenseOutput, FieldFrames, MovedRings, Sections, StepRecords, ElementClocks,
                               KktPattern, ActionDefect, ParameterMaps, StartSets, FoundEvents, FoundImpacts>;
    std::vector<Value> all_;
};

/// A set of products.
class ProductPlan {
public:
    ProductPlan() = default;
    /// What the views of a scene need, its default views where it names none, and what its export needs.
    explicit ProductPlan(const ResolvedScene& resolved);

    bool has(Product product) const { return std::find(all_.begin(), all_.end(), product) != all_.end(); }
    void add(Product product) {
        if (!has(product)) all_.push_back(product);
    }
    /// Short runs are repeated for their CPU time (run/march/timing.hpp).
    bool isTimed = true;

private:
    std::vector<Product> all_;
};

/// Whether a view needs a product.
bool needs(const View& view, Product product);

}  // namespace extremal
