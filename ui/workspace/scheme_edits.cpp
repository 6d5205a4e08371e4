// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/scheme_edits.hpp"

#include <algorithm>
#include <cmath>

#include "engine/baseline/catalog.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/family/scheme.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/view/catalog.hpp"
#include "ui/workspace/fitting.hpp"

namespace extremal {

namespace {

/// One, two or five times a power of ten, not above x.
double roundStep(double x) {
    const double power = std::pow(10, std::floor(std::log10(x)));
    const double lead = x / power;
    const double digit = lead >= 5 ? 5 : lead >= 2 ? 2 : 1;
    const int exponent = static_cast<int>(std::lround(std::log10(power)));
    return exponent >= 0 ? digit * power : digit / std::pow(10, -exponent);
}

Settings withDefaults(const CatalogItem& item) {
    Settings settings;
    settings.type = item.id;
    for (const FieldInfo& f : item.parameters) settings.keys.emplace_back(f.key, f.firstValue());
    return settings;
}

void setKey(Settings& settings, const std::string& key, Value value) {
    for (auto& member : settings.keys)
        if (member.first == key) member.second = value;
}

const CatalogItem* itemOf(const std::vector<CatalogItem>& items, std::string_view id) {
    const auto found =
        std::find_if(items.begin(), items.end(), [&](const CatalogItem& i) { return i.id == id; });
    return found == items.end() ? nullptr : &*found;
}

std::string pairLabel(const Settings& space, const Settings& quadrature) {
    const Properties known = describe(space, quadrature);
    if (!known.knownAs.empty()) return known.knownAs;
    const CatalogItem* rule = itemOf(quadratureCatalog(), quadrature.type);
    return known.prefix + (rule ? rule->title : quadrature.type) + " " + std::to_string(known.claims.order);
}

/// The length of an element follows from their number.
bool hasImpliedStep(const Settings& space) { return familyPart<StepOfSpace>(space) != nullptr; }

std::string place(int index) { return "/schemes/" + std::to_string(index); }

}  // namespace

Value settingsTree(const Settings& settings) {
    Value tree(Value::Object{{"type", settings.type}});
    for (const auto& [key, value] : settings.keys)
        if (!value.isNull()) tree.set(key, value);
    return tree;
}

double sensibleStep(const Scene& scene, int order, double stabilityLimit) {
    const ModelEntry* entry = findModel(scene.model.type);
    double step = entry ? entry->exampleStep : timeSpan(scene).length() / 200;
    for (const SchemeSpec& spec : scene.schemes)
        if (spec.kind == SchemeSpec::Kind::discretization && spec.step.value > 0 &&
            describe(spec.space, spec.quadrature).claims.order == order)
            return spec.step.value;
    if (std::isfinite(stabilityLimit) && stabilityLimit > 0) step /= 2;
    if (order > 4) step *= order / 4.0;
    return roundStep(step * 1.0001);
}

std::string uniqueLabel(const Scene& scene, const std::string& wish) {
    const auto isTaken = [&](const std::string& label) {
        return std::any_of(scene.schemes.begin(), scene.schemes.end(),
                           [&](const SchemeSpec& s) { return s.label == label; });
    };
    std::string label = wish;
    for (int n = 2; isTaken(label); ++n) label = wish + " (" + std::to_string(n) + ")";
    return label;
}

/// The step, or nine tenths of the largest that is stable on the mesh of the scheme.
double stableStep(const Scene& scene, const Settings& space, const Settings& quadrature, double step) {
    const auto* const limit = familyPart<LargestStep>(space);
    if (!limit) return step;
    try {
        ResolvedScheme scheme;
        scheme.family = familyOf(space);
        scheme.discretization = {space, quadrature, {}};
        resolveSystem(scheme, scene);
        const System system = scheme.ownSystem ? *scheme.ownSystem : makeSystem(scene);
        const State start = scheme.ownSystem ? scheme.ownInitial : initialState(scene, system);
        const double largest = limit->of(system, scheme.discretization, start);
        return largest > 0 && step > 0.9 * largest ? roundStep(0.9 * largest) : step;
    } catch (const InvalidScene&) {
        return step;  // what is wrong with the scene is said elsewhere
    }
}

Value newPair(const Scene& scene, const Settings& space, const Settings& quadrature) {
    const Properties known = describe(space, quadrature);
    Value scheme{Value::Object{}};
    scheme.set("label", uniqueLabel(scene, pairLabel(space, quadrature)));
    if (!hasImpliedStep(space))
        scheme.set("step", stableStep(scene, space, quadrature,
                                      sensibleStep(scene, known.claims.order, known.stabilityLimit)));
    scheme.set("space", settingsTree(space));
    // Panels that follow the cells of the space are left to do so when these are edited.
    Settings rule = quadrature;
    if (rule.integer("panels") == ruleFor(rule.type, space).integer("panels"))
        setKey(rule, "panels", Value());
    scheme.set("quadrature", settingsTree(rule));
    return scheme;
}

Value newBaseline(const Scene& scene, const std::string& id) {
    const BaselineEntry* entry = findBaseline(id);
    Value scheme{Value::Object{}};
    scheme.set("label", uniqueLabel(scene, entry ? entry->item.title : id));
    if (entry && entry->isAdaptive())
        scheme.set("tolerance", 1e-9);
    else
        scheme.set("step",
                   sensibleStep(scene, entry && entry->item.claims ? entry->item.claims->order : 2, 0));
    scheme.set("baseline", id);
    return scheme;
}

Value newNamed(const Scene& scene, const std::string& id) {
    Value scheme{Value::Object{}};
    const auto discretization = namedScheme(id);
    const Properties known =
        discretization ? describe(discretization->space, discretization->quadrature) : Properties{};
    scheme.set("label", uniqueLabel(scene, id));
    if (!discretization || !hasImpliedStep(discretization->space))
        scheme.set("step", sensibleStep(scene, known.claims.order, known.stabilityLimit));
    scheme.set("scheme", id);
    return scheme;
}

Value newOwn(const Scene& scene, const Value& kept) {
    Value scheme = kept;
    scheme.set("label", uniqueLabel(scene, kept.find("label")->asString()));
    if (!scheme.find("step") && !scheme.find("tolerance")) scheme.set("step", sensibleStep(scene, 0, 0));
    return scheme;
}

namespace {

/// A scheme as a tree, with its colour and dash.
struct StyledScheme {
    Value tree;
    int style;
};

std::vector<StyledScheme> styledSchemes(const Scene& scene) {
    std::vector<StyledScheme> schemes;
    const Value document = toValue(scene);
    for (std::size_t i = 0; i < scene.schemes.size(); ++i)
        schemes.push_back({document.find("schemes")->asArray()[i], styleOf(scene.schemes[i], i)});
    return schemes;
}

/// The least number that no scheme has.
int freeStyle(const Scene& scene) {
    const std::vector<StyledScheme> schemes = styledSchemes(scene);
    int style = 0;
    while (std::any_of(schemes.begin(), schemes.end(), [&](const auto& s) { return s.style == style; }))
        ++style;
    return style;
}

/// Styles that differ from the place in the list are written down.
std::vector<Edit> editsForSchemes(std::vector<StyledScheme> schemes) {
    Value::Array trees;
    for (StyledScheme& scheme : schemes) {
        std::erase_if(scheme.tree.asObject(), [](const Value::Member& m) { return m.first == "style"; });
        if (scheme.style != static_cast<int>(trees.size())) scheme.tree.set("style", scheme.style + 1);
        trees.push_back(std::move(scheme.tree));
    }
    return {{"/schemes", Value(std::move(trees))}};
}

}  // namespace

std::vector<Edit> editsForAdding(const Scene& scene, const Value& scheme) {
    Value styled = scheme;
    if (const int style = freeStyle(scene); style != static_cast<int>(scene.schemes.size()))
        styled.set("style", style + 1);
    return {{"/schemes/-", std::move(styled)}};
}

std::vector<Edit> editsForDuplicate(const Scene& scene, int index) {
    std::vector<StyledScheme> schemes = styledSchemes(scene);
    StyledScheme copy{schemes.at(static_cast<std::size_t>(index)).tree, freeStyle(scene)};
    copy.tree.set("label", uniqueLabel(scene, scene.schemes[static_cast<std::size_t>(index)].label));
    schemes.insert(schemes.begin() + index + 1, std::move(copy));
    return editsForSchemes(std::move(schemes));
}

std::vector<Edit> editsForRemoval(const Scene& scene, int index) {
    std::vector<StyledScheme> schemes = styledSchemes(scene);
    schemes.erase(schemes.begin() + index);
    return editsForSchemes(std::move(schemes));
}

std::vector<Edit> editsForMove(const Scene& scene, int index, int by) {
    std::vector<StyledScheme> schemes = styledSchemes(scene);
    const int other = index + by;
    if (other < 0 || other >= static_cast<int>(schemes.size())) return {};
    std::swap(schemes[static_cast<std::size_t>(index)], schemes[static_cast<std::size_t>(other)]);
    return editsForSchemes(std::move(schemes));
}

std::vector<Edit> editsForToggle(const Scene& scene, int index) {
    return {{place(index) + "/enabled", !scene.schemes[static_cast<std::size_t>(index)].isEnabled}};
}

std::vector<Edit> editsForSolo(const Scene& scene, int index) {
    const auto own = static_cast<std::size_t>(index);
    bool isAlone = scene.schemes[own].isEnabled;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i)
        isAlone = isAlone && (i == own || !scene.schemes[i].isEnabled);
    std::vector<Edit> edits;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i)
        if (const bool isOn = isAlone || i == own; isOn != scene.schemes[i].isEnabled)
            edits.push_back({place(static_cast<int>(i)) + "/enabled", isOn});
    return edits;
}

std::vector<Edit> editsForStyle(const Scene& scene, int index, int style) {
    std::vector<StyledScheme> schemes = styledSchemes(scene);
    int& own = schemes[static_cast<std::size_t>(index)].style;
    if (own == style) return {};
    for (StyledScheme& other : schemes)
        if (other.style == style) other.style = own;
    own = style;
    return editsForSchemes(std::move(schemes));
}

std::vector<Edit> editsForStep(const Scene& scene, int index, double factor) {
    const SchemeSpec& spec = scene.schemes[static_cast<std::size_t>(index)];
    const double now = spec.tolerance ? *spec.tolerance : spec.step.value;
    if (!(now > 0)) return {};
    const double unit = std::pow(10.0, std::floor(std::log10(now * factor)) - 2);
    // Through text, so that the number is the shortest one.
    const auto next = parseNumber(formatNumber(std::round(now * factor / unit) * unit, 3));
    if (!next || *next == now) return {};
    return {{place(index) + (spec.tolerance ? "/tolerance" : "/step"), *next}};
}

Value exampleModel(const ModelEntry& entry) {
    Value model(Value::Object{{"type", entry.item.id}});
    for (const FieldInfo& field : entry.item.parameters)
        if (!field.example.isNull()) model.set(field.key, field.example);
    return model;
}

Value newLagrangianScene() {
    const ModelEntry* entry = findModel("lagrangian");
    const double step = entry->exampleStep > 0 ? entry->exampleStep : 0.1;
    Value scene(Value::Object{{"extremal", 1}, {"title", "A Lagrangian of my own"}});
    scene.set("model", exampleModel(*entry));
    scene.set("time", Value(Value::Object{{"start", 0}, {"end", 200 * step}}));
    scene.set("schemes",
              Value(Value::Array{
                  Value(Value::Object{
                      {"label", "Galerkin Gauss 4"}, {"step", step}, {"scheme", "galerkin-gauss-2"}}),
                  Value(Value::Object{{"label", "RK4"}, {"step", step}, {"baseline", "rk4"}})}));
    return scene;
}

std::vector<Edit> editsForModel(const Scene& scene, const ModelEntry& entry) {
    const ModelEntry* old = findModel(scene.model.type);
    const double scale = old && old->exampleStep > 0 ? entry.exampleStep / old->exampleStep : 1;
    std::vector<Edit> edits = {{"/model", exampleModel(entry)},
                               {"/initial", std::nullopt},
                               {"/views", std::nullopt},
                               {"/observe", std::nullopt},
                               {"/output", std::nullopt},
                               {"/title", entry.item.title},
                               {"/source", std::nullopt},
                               {"/lesson", std::nullopt},
                               {"/notes", std::nullopt},
                               {"/time", Value(Value::Object{{"start", 0}, {"end", entry.exampleEnd}})}};
    Scene next;
    next.model.type = entry.item.id;
    for (const FieldInfo& f : entry.item.parameters) next.model.keys.emplace_back(f.key, f.firstValue());
    const System system = entry.make(next.model);
    const ChoiceGrid choices = choicesFor(system);
    next.end.value = entry.exampleEnd;
    Value::Array schemes;
    const Value document = toValue(scene);
    for (std::size_t i = 0; i < scene.schemes.size(); ++i) {
        const SchemeSpec& spec = scene.schemes[i];
        const auto discretization = discretizationOf(spec);
        const BaselineEntry* baseline = findBaseline(spec.baseline.type);
        const bool fits =
            discretization ? isFor(*discretization, system) : baseline && appliesTo(*baseline, system);
        if (!fits && !discretization) continue;
        Value scheme = fits ? document.find("schemes")->asArray()[i] : Value();
        if (!fits) {
            const ChoiceGrid::Cell* const choice =
                nearestChoice(choices, discretization->quadrature.type,
                              std::clamp(discretization->space.integer("degree"), 2, 8));
            const bool areElements = hasImpliedStep(discretization->space) ||
                                     (choice && hasImpliedStep(choice->discretization.space));
            if (!choice || (areElements && !schemes.empty())) continue;  // one stands for all
            scheme = newPair(next, choice->discretization.space, choice->discretization.quadrature);
        }
        if (spec.step.value > 0 && scheme.find("step"))
            scheme.set("step", roundStep(spec.step.value * scale * 1.0001));
        scheme.set("enabled", spec.isEnabled);
        next.schemes.emplace_back();
        next.schemes.back().label = scheme.find("label")->asString();
        schemes.push_back(std::move(scheme));
    }
    if (const ChoiceGrid::Cell* choice = nearestChoice(choices, "gauss", 2); choice && schemes.empty())
        schemes.push_back(newPair(next, choice->discretization.space, choice->discretization.quadrature));
    edits.push_back({"/schemes", std::move(schemes)});
    const bool isOfOldModel = scene.reference.kind == ReferenceSpec::Kind::exact ||
                              scene.reference.kind == ReferenceSpec::Kind::file;
    if (isOfOldModel) edits.push_back({"/reference", std::nullopt});
    return edits;
}

std::vector<Edit> editsForCase(const Scene& scene, const View& view, double value, double step) {
    const MapGrid grid = mapGridOf(scene, view);
    const auto found = std::find_if(scene.schemes.begin(), scene.schemes.end(),
                                    [&](const SchemeSpec& s) { return s.label == view.scheme; });
    if (grid.pointer.empty() || found == scene.schemes.end()) return {};
    return {{grid.pointer, value}, {place(static_cast<int>(found - scene.schemes.begin())) + "/step", step}};
}

std::vector<Edit> editsForView(const Scene& scene, const std::string& id, bool isShown) {
    const Value document = toValue(scene);
    Value::Array views;
    for (std::size_t i = 0; i < scene.views.size(); ++i)
        if (scene.views[i].id != id) views.push_back(document.find("views")->asArray()[i]);
    if (isShown) views.emplace_back(id);
    std::vector<Edit> edits{{"/views", Value(std::move(views))}};
    const ViewEntry* entry = findView(id);
    const bool isMissing =
        isShown && entry && !entry->observable.empty() &&
        std::find(scene.observe.begin(), scene.observe.end(), entry->observable) == scene.observe.end();
    if (!isMissing) return edits;
    Value::Array observe(scene.observe.begin(), scene.observe.end());
    observe.emplace_back(entry->observable);
    edits.push_back({"/observe", Value(std::move(observe))});
    return edits;
}

Settings spaceOf(const std::string& id, int degree) {
    const CatalogItem* item = itemOf(spaceCatalog(), id);
    Settings space = item ? withDefaults(*item) : Settings{};
    setKey(space, "degree", degree);
    return space;
}

std::string fittingRule(const std::string& rule, const Settings& space) {
    const Family* const family = familyOf(space);
    if (!family) return rule;
    const std::vector<std::string> fitting = family->rules(space);
    const bool fits = std::find(fitting.begin(), fitting.end(), rule) != fitting.end();
    return fits || fitting.empty() ? rule : fitting.front();
}

Settings ruleFor(const std::string& id, const Settings& space) {
    const CatalogItem* item = itemOf(quadratureCatalog(), id);
    return completeQuadrature(space, item ? withDefaults(*item) : Settings{});
}

}  // namespace extremal
