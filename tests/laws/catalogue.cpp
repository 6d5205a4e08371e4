// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/laws/catalogue.hpp"

#include <QtGlobal>

#include <algorithm>
#include <set>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/subjects.hpp"

namespace extremal::laws {
namespace {

constexpr int lowDegree = 3;  ///< to which every space is taken; and orders beyond 6 are hidden by round-off

/// A step of high degree in many unknowns takes milliseconds.
bool isAffordable(int degree, const System& system) {
    if (degree <= lowDegree) return true;
    return (degree % 4 == 0 || degree == lowDegree + 1) && degree * std::max(1, system.dimension()) <= 48;
}

/// The values of a key that are worth a variant.
std::vector<Value> valuesOf(const FieldInfo& f, int most) {
    std::vector<Value> values;
    const bool isSize = f.key == "degree" || f.key == "stages";
    if (f.type == FieldType::integer && isSize && f.choices.empty())
        for (int s = static_cast<int>(f.min); s <= std::min<double>(most, f.max); ++s) values.emplace_back(s);
    else if (f.type == FieldType::boolean)
        values = {false, true};
    else if (!f.choices.empty() && f.key != "basis" && f.type == FieldType::choice)
        for (const std::string& choice : f.choices) values.emplace_back(choice);
    else if (!f.choices.empty() && f.type == FieldType::integer)
        for (const std::string& choice : f.choices) values.emplace_back(parseNumber(choice).value_or(0));
    else if (!f.firstValue().isNull())
        values = {f.firstValue()};  // else the family completes it
    return values;
}

/// The type, and what differs from the defaults.
std::string nameOf(const Settings& settings, const CatalogItem& item) {
    std::string name = settings.type;
    for (const FieldInfo& f : item.parameters)
        if (const Value* value = settings.find(f.key); value && *value != f.fallback) {
            if (value->isNumber()) name += " " + formatNumber(value->asNumber());
            if (value->isString()) name += " " + value->asString();
            if (value->isBool()) name += (value->asBool() ? " " : " not ") + f.key;
        }
    return name;
}

class Everything {
public:
    Everything(const System& system, const State& start, double step)
        : system_(system), start_(start), step_(step) {}

    std::vector<CatalogueScheme> all() {
        addNamed();
        addBaselines();
        addCompositions();
        for (const Family& family : families())
            if (appliesTo(family, system_)) addSpaces(family);
        return std::move(all_);
    }

private:
    void add(std::string name, Group group, int degree, const SchemeSpec& spec) {
        CatalogueScheme c{std::move(name), group, degree, resolve(spec, &system_)};
        c.scheme.spec.label = c.name;
        c.scheme.spec.step = {c.scheme.isAdaptive() ? 0 : step_, {}};
        if (!c.scheme.fits(system_) || !names_.insert(c.name).second) return;
        if (const Discretization* const plain = c.scheme.plain()) {
            const Properties& p = c.scheme.properties;
            const bool isKnown = std::find(known_.begin(), known_.end(), *plain) != known_.end();
            if (isKnown || !p.refusal.empty() || !p.caution.empty() || p.stabilityLimit <= 0) return;
            known_.push_back(*plain);
        }
        try {
            (void)c.make(system_, step_, start_);
            if (c.scheme.family)
                c.scheme.discretization = withEstimates(c.scheme.discretization, system_, start_);
            all_.push_back(std::move(c));
        } catch (const InvalidScene&) {
        }
    }

    void addNamed() {
        for (const SchemeEntry& e : schemeCatalog())
            for (int degree = e.maxDegree == 0 ? 0 : e.minDegree; degree <= e.maxDegree; ++degree) {
                if (!isAffordable(degree, system_)) continue;
                SchemeSpec spec;
                spec.kind = SchemeSpec::Kind::named;
                spec.named = e.item.id;
                if (const auto at = spec.named.find('<'); at != std::string::npos)
                    spec.named = spec.named.substr(0, at) + std::to_string(degree);
                add(spec.named, Group::named, degree, spec);
            }
    }

    void addBaselines() {
        for (const BaselineEntry& e : baselineCatalog()) {
            if (!appliesTo(e, system_)) continue;
            for (const Settings& keys : everyVariant(e.item, lowDegree)) {
                SchemeSpec spec;
                spec.kind = SchemeSpec::Kind::baseline;
                spec.baseline = keys;
                if (e.isAdaptive()) spec.tolerance = 1e-9;
                add(nameOf(keys, e.item), Group::baseline, keys.integer("degree"), spec);
            }
        }
    }

    /// Two orders up, from order 2 and from order 4.
    void addCompositions() {
        const std::vector<CatalogueScheme> simple = all_;
        for (const CatalogueScheme& c : simple)
            for (const CatalogItem& item : compositionCatalog()) {
                SchemeSpec spec = c.scheme.spec;
                spec.composition = {
                    item.id, {{"order", static_cast<double>(defaultOrder(item.id, c.claims()))}}, {}};
                const bool isPossible = !c.scheme.isAdaptive() && isComposableBy(item.id, c.claims());
                if (isPossible && c.claims().order <= 4)
                    add(item.id + " of " + c.name, Group::composition, c.degree, spec);
            }
    }

    void addSpaces(const Family& family) {
        const auto addPair = [&](const std::string& name, Settings space, Settings quadrature) {
            SchemeSpec spec;
            spec.space = std::move(space);
            spec.quadrature = completeQuadrature(spec.space, quadrature);
            const int degree = spec.space.integer("degree");
            add(name, Group::space, degree, spec);
        };
        for (const SpaceEntry& e : family.spaces)
            for (const Settings& space : everyVariant(e.item, lowDegree))
                for (const std::string& id : family.rules(space)) {
                    const RuleEntry* const rule = findRule(id);
                    for (const Settings& variant :
                         rule ? everyVariant(rule->item, 0) : std::vector<Settings>{{id, {}, {}}})
                        addPair(nameOf(space, e.item) + " x " +
                                    (rule ? nameOf(variant, rule->item) : variant.type),
                                space, variant);
                }
        if (familyFor(system_) != &family) return;
        for (const ChoiceGrid::Cell& cell : family.choices(system_).cells) {
            const Discretization& d = cell.discretization;
            if (isAffordable(d.space.integer("degree"), system_))
                addPair("choice " + cell.id, d.space, d.quadrature);
        }
    }

    const System& system_;
    const State& start_;
    double step_;
    std::vector<CatalogueScheme> all_;
    std::vector<Discretization> known_;
    std::set<std::string> names_;
};

/// A scene, the scheme that makes it one, and the step of those it is given.
struct Ground {
    const char *scene, *scheme;
    double step;
};
const Ground grounds[] = {
    {R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":2})",
     "midpoint", 0.02},
    {R"J({"extremal":1,"model":{"type":"lagrangian","coordinates":["x","y","u","v"],"parameters":{"m":0.05},"lagrangian":"(x_t^2+y_t^2)/2+m/2*(u_t^2+v_t^2)+1/sqrt(x^2+y^2)+m/sqrt(u^2+v^2)+m/20/sqrt((x-u)^2+(y-v)^2)"},"initial":{"q":[1,0,-2,0.1],"v":[0,1.1,0,-0.6]},"time":{"end":8})J",
     "kepler-arcs-1", 0.1},
    // Of the oscillation 0.5 rad a step, and 10 for the spaces that contain it.
    {R"({"extremal":1,"model":{"type":"spring-pendulum"},"initial":{"q":[0.1,1],"p":[0,0]},"time":{"end":2})",
     "midpoint", 0.005},
    {R"({"extremal":1,"model":{"type":"spring-pendulum"},"initial":{"q":[0.1,1],"p":[0,0]},"time":{"end":2})",
     "multiscale-r1", 0.1},
    {R"({"extremal":1,"model":{"type":"rigid-body"},"initial":{"attitude":[1,0,0,0],"momentum":[0.5,0.2,0.8]},"time":{"end":2})",
     "lie-1", 0.05},
    {R"({"extremal":1,"model":{"type":"schrodinger","modes":64,"potential":"1 - cos(x) "},"initial":{"psi":{"packet":"periodic-gaussian","kappa":4,"centre":0.6,"wave_number":2}},"time":{"end":0.1})",
     "schrodinger-gauss-1", 0.002},
    {R"({"extremal":1,"model":{"type":"schrodinger","modes":64,"potential":"1 - cos(x - t) "},"initial":{"psi":{"packet":"periodic-gaussian","kappa":4,"centre":0.6,"wave_number":2}},"time":{"end":0.1})",
     "schrodinger-gauss-1", 0.002},
    {R"({"extremal":1,"model":{"type":"multiscale-elliptic","a":"10/(1+0.95*sin(2*pi*s)) ","epsilon":0.025,"f":"x^2","elements":50})",
     "elliptic-linear", 0.02},
    {R"({"extremal":1,"model":{"type":"field","potential":"sine-gordon","domain":[-20,20],"boundary":"periodic","cells":41},"initial":{"profile":"breather","omega":0.9},"time":{"end":2})",
     "multisymplectic-1", 0.05},
};

}  // namespace

std::vector<Scene> everyGround() {
    std::vector<Scene> scenes;
    std::vector<std::vector<const PartInfo*>> kinds;
    for (const Ground& ground : grounds) {
        const ReadScene read =
            readScene(std::string(ground.scene) + ",\"schemes\":[{\"scheme\":\"" + ground.scheme +
                      "\",\"step\":" + std::to_string(ground.step) + "}]}");
        if (!read.errors.empty()) qFatal("%s", read.errors.front().message.c_str());
        scenes.push_back(read.scene);
        kinds.push_back(makeSystem(read.scene).parts.needs());
    }
    for (const Preset* preset : onePerModel()) {
        const Scene scene = readScene(preset->json).scene;
        const System system = makeSystem(scene);
        if (!system.isMotion()) continue;  // the one above is enough
        const auto kind = system.parts.needs();
        if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) continue;
        kinds.push_back(kind);
        scenes.push_back(scene);
    }
    return scenes;
}

bool CatalogueScheme::claimsToConserve(const std::string& what) const {
    const auto& kept = claims().conserves;
    return std::find(kept.begin(), kept.end(), what) != kept.end();
}

std::vector<Settings> everyVariant(const CatalogItem& item, int most) {
    std::vector<Settings> all{{item.id, {}, {}}};
    for (const FieldInfo& f : item.parameters) {
        const std::vector<Value> values = valuesOf(f, most);
        if (values.empty()) continue;
        std::vector<Settings> next;
        for (const Settings& settings : all)
            for (const Value& value : values) {
                next.push_back(settings);
                next.back().keys.emplace_back(f.key, value);
            }
        all = std::move(next);
    }
    return all;
}

std::vector<CatalogueScheme> everythingOn(const System& system, const State& start, double step) {
    return Everything(system, start, step).all();
}

}  // namespace extremal::laws
