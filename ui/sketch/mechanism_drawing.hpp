// SPDX-License-Identifier: GPL-3.0-or-later
/// A mechanism while it is drawn: the value of a model "mechanism", what is where, and changes by hand that
/// can be taken back one by one. It may be incomplete, as a drawing is before it is done.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

class MechanismDrawing {
public:
    using Place = std::array<double, 2>;
    /// An element: "rods" and "crank".
    struct Element {
        std::string kind, name;
        bool operator==(const Element&) const = default;
    };
    /// What a line of the drawing stands for; a and b are equal where it is a point.
    struct Line {
        Element element;
        Place a{}, b{};
    };

    /// Of an object of type "mechanism"; anything else begins an empty one.
    explicit MechanismDrawing(const Value& model = {});

    const Value& model() const { return states_[state_]; }
    bool isEmpty() const;
    const Value* find(const Element& element) const;

    /// Points, points of bodies included, and the centres of bodies.
    std::optional<Place> placeOf(const Element& element) const;
    std::vector<Line> points() const;  ///< these with their places
    std::vector<Line> lines() const;   ///< everything else
    bool isFixed(const std::string& point) const;
    /// The size of what is drawn, at least 1.
    double size() const;

    std::optional<Element> pointAt(const Place& place, double reach) const;  ///< no centre of a body
    /// A point if there is one, else the nearest line.
    std::optional<Element> elementAt(const Place& place, double reach) const;

    // Changes, each a state to come back from. Where nothing changes there is no new state.

    Element addPoint(const Place& place, bool isFixed);
    /// Between two points, which are made where there are none yet; a point within `reach` is taken.
    Element addLink(const std::string& kind, const Place& from, const Place& to, double reach);
    Element addGroundDamper(const std::string& point);
    /// A bar with a point at each end, which is pinned to a point that is there already.
    Element addBody(const Place& from, const Place& to, double reach);
    std::optional<Element> addMotor(const Element& rodOrBody);
    /// Along a line; the side on which most points are is the open one.
    Element addWall(const Place& from, const Place& to);
    Element addSlider(const std::string& point, const Place& towards);
    void toggleFixed(const std::string& point);
    void move(const Element& pointOrBody, const Place& to);
    /// With what hangs on it.
    void remove(const Element& element);
    /// False: the name is taken, or is no name.
    bool rename(const Element& element, const std::string& name);
    /// Null: the key is left out.
    void setKey(const Element& element, const std::string& key, const Value& value);
    /// Another model altogether, as from a form.
    void replace(const Value& model);

    bool canUndo() const { return state_ > 0; }
    bool canRedo() const { return state_ + 1 < states_.size(); }
    void undo() { state_ -= canUndo() ? 1 : 0; }
    void redo() { state_ += canRedo() ? 1 : 0; }

private:
    double number(const Value* value, double otherwise) const;
    Place pair(const Value* value) const;
    const Value* elementsOf(const char* kind) const;
    void push(Value model);
    std::string freeName(const Value& model, const std::string& stem) const;
    std::string pointFor(Value& model, const Place& place, double reach) const;
    static Value& add(Value& model, const std::string& kind, const std::string& name, Value element);

    std::vector<Value> states_;
    std::size_t state_ = 0;
};

}  // namespace extremal
