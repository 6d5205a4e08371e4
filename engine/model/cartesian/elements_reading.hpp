// SPDX-License-Identifier: GPL-3.0-or-later
/// Elements by name, of the kinds of a table: what their reading has in common, in the plane and in space.
/// Internal to the models of mechanisms.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/settings.hpp"
#include "engine/model/cartesian/element_kinds.hpp"
#include "engine/model/cartesian/element_reader.hpp"
#include "engine/model/cartesian/elements.hpp"

namespace extremal::cartesian {

/// Says which keys of a point do not go together: one moves by itself, is fixed, or belongs to a body.
void checkPoint(const ElementReader& r, bool isOfBody, bool isFixed);

class ElementsReading {
protected:
    /// Reads the parameters, and checks that every element has a name of its own, which a formula could have.
    ElementsReading(const Settings& settings, const std::vector<ElementKind>& kinds);

    /// Reads the elements of a kind, one after the other.
    template <class Read>
    void each(const char* key, Read readOne) {
        for (const ElementKind& kind : kinds_) {
            if (kind.key != key) continue;
            for (const auto& [name, given] : of(kind.key))
                if (const ElementReader reader(kind, name, given, parameters_, problems_); given.isObject())
                    readOne(reader);
        }
    }
    /// The place of an element that another one names, among those of its kind ("bodies"); 0 and a problem
    /// where there is none.
    std::size_t place(const char* kind, const ElementReader& r, const char* key);
    /// The same for a name that stands in a list.
    std::size_t placeOf(const char* kind, const std::string& name, const std::string& pointer);
    std::optional<std::size_t> placeIfGiven(const char* kind, const ElementReader& r, const char* key);

    Link link(const ElementReader& r);
    RodElement rod(const ElementReader& r);
    SpringElement spring(const ElementReader& r);
    /// Of a point, of two, or of a body.
    DamperElement damper(const ElementReader& r);
    /// The points that a wall stops: those that it names, or all of these that are not fixed.
    template <class Point>
    std::vector<std::size_t> stopped(const ElementReader& r, const std::vector<Point>& points) {
        std::vector<std::size_t> all;
        for (const std::string& name : r.names("points"))
            all.push_back(placeOf("points", name, r.pointer("points")));
        if (!r.has("points"))
            for (std::size_t k = 0; k < points.size(); ++k)
                if (!points[k].isFixed) all.push_back(k);
        if (all.empty()) r.error("points", "there is no point that it could stop", "name one");
        return all;
    }

    Parameters parameters_;
    std::vector<Problem> problems_;

private:
    const Value::Object& of(const std::string& key) const;

    const Settings& settings_;
    const std::vector<ElementKind>& kinds_;
    std::map<std::string, std::vector<std::string>> names_;  ///< of the elements of each kind
};

}  // namespace extremal::cartesian
