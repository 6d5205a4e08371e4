// SPDX-License-Identifier: GPL-3.0-or-later
/// Everything that the catalogues offer for a system, as a scene would name it: every named scheme at its
/// degrees, every space of every family with every rule that the family gives it, the choices that the window
/// offers, every baseline in each of its variants, and the compositions of what can be composed. A new entry
/// of any catalogue is here by itself.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/resolve.hpp"

namespace extremal::laws {

enum class Group { named, baseline, space, composition };

struct CatalogueScheme {
    std::string name;  ///< unique: the id with its degree or with the keys that differ from their defaults
    Group group = Group::named;
    int degree = 0;  ///< 0: none
    ResolvedScheme scheme;

    const Claims& claims() const { return scheme.claims; }
    bool claimsToConserve(const std::string& what) const;
    std::unique_ptr<Integrator> make(const System& system, double step, const State& start) const {
        return scheme.make(system, step, start);
    }
};

/// What an entry with these keys can be: every choice and flag, degrees, stages and orders up to `most`,
/// other numbers as they are by default. Bases of one space are left alone: their steps are the same
/// (laws.routes).
std::vector<Settings> everyVariant(const CatalogItem& item, int most);

/// Left out are discretizations that are refused, unstable at every step or of no claim (they come with a
/// caution), those that are there under another name, and what cannot be made for this start and step. High
/// degrees are thinned out, and are for systems of few coordinates.
std::vector<CatalogueScheme> everythingOn(const System& system, const State& start, double step);

/// Scenes of each kind of system, with one scheme of a step that suits all of them: driven and at rest, and
/// of kinds that are not known here the first preset.
std::vector<Scene> everyGround();

}  // namespace extremal::laws
