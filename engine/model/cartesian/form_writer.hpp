// SPDX-License-Identifier: GPL-3.0-or-later
/// What the writing of a typed Lagrangian from elements has in common, in the plane and in space. Internal to
/// the models of mechanisms.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/cartesian/elements.hpp"
#include "engine/model/parts/written_form.hpp"

namespace extremal::cartesian {

class FormWriter {
protected:
    explicit FormWriter(const std::vector<std::pair<std::string, double>>& parameters);

    /// A coordinate of an element, with its place and velocity at the start. Throws InvalidScene where the
    /// name is that of a parameter.
    void addCoordinate(const std::string& name, double q, double v, const std::string& pointer);
    /// A number as a parameter, where its name is free; a formula as it is.
    std::string amount(const Amount& given, const std::string& name, const std::string& pointer);
    void addTerm(const std::string& term);
    void subtractTerm(const std::string& term);
    void addConstraint(const std::string& name, const std::string& formula, const std::string& pointer);
    /// A term of Rayleigh's function.
    void damp(const std::string& term);
    void force(const std::string& coordinate, const std::string& formula, const std::string& pointer);
    void addWall(const std::string& name, const std::string& gap, const Amount& restitution,
                 const std::string& pointer);
    /// The whole. A Lagrangian that is too long for one formula is written in terms. Throws InvalidScene
    /// where it is too long for these, too.
    WrittenForm written();

private:
    /// Formulas by name, in the order in which they are first named.
    class Texts {
    public:
        void add(const std::string& name, const std::string& term);
        bool isEmpty() const { return all_.empty(); }
        Value value() const { return Value(all_); }

    private:
        Value::Object all_;
    };
    Value lagrangian() const;

    WrittenForm form_;
    Value::Array names_;
    Value::Object parameters_, walls_;
    std::set<std::string> taken_;
    std::vector<std::string> terms_;  ///< of L, with their signs
    std::string dissipation_;
    Texts constraints_, forces_;
};

}  // namespace extremal::cartesian
