// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/passport.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/parts/test_space.hpp"
#include "engine/family/parts/written_on_system.hpp"
#include "engine/passport/measured.hpp"
#include "engine/passport/scene_formula.hpp"
#include "engine/passport/scheme_tableau.hpp"
#include "engine/passport/tableau_page.hpp"
#include "engine/phase/monitored.hpp"
#include "engine/scene/outlook/scheme_stability.hpp"

namespace extremal {
namespace {

std::string claimsText(Claims claims, const System& system) {
    if (!system.isUnitary) std::erase(claims.conserves, "norm");  // splittings are for wave functions as well
    std::vector<std::string> words;
    if (claims.order > 0) words.push_back("order " + std::to_string(claims.order));
    if (claims.isSymmetric) words.emplace_back("symmetric");
    if (claims.isSymplectic) words.emplace_back("symplectic");
    if (!claims.isOneStep) words.emplace_back("carries more than the state from step to step");
    std::string text = words.empty() ? "nothing" : joinNames(words);
    if (!claims.conserves.empty()) text += "; keeps " + joinNames(claims.conserves);
    return text;
}

std::string ruleText(const Settings& quadrature) {
    std::string text = quadrature.type.empty() ? "by terms" : quadrature.type;
    for (const char* key : {"nodes", "panels", "phases"})
        if (const Value* v = quadrature.find(key); v && v->isNumber() && (*key != 'p' || v->asNumber() > 1))
            text += ", " + formatCount(v->asNumber()) + " " + key;
    return text;
}

void addKind(const ResolvedScene& scene, const ResolvedScheme& scheme, Document& page) {
    Document::Table t{{"", ""}, {}};
    const auto add = [&](const std::string& name, const std::string& value) {
        if (!value.empty()) t.rows.push_back({name, value});
    };
    add("scene", scene.scene.title);
    add("system", scene.system->id);
    if (const auto formula = scene.system->isMovedOnlyBy<Mechanical>() ? formulaOf(scene) : std::nullopt)
        add("Lagrangian", formula->text);
    if (scheme.family) {
        add("family", scheme.family->item.title);
        add("source", scheme.family->source);
        add("space",
            scheme.properties.space.empty() ? scheme.discretization.space.type : scheme.properties.space);
        add("rule", ruleText(scheme.discretization.quadrature));
        add("known as", scheme.properties.knownAs);
    } else {
        add("baseline", scheme.baseline->item.title);
        add("", scheme.baseline->item.description);
    }
    if (scheme.isComposed()) {
        std::string parts;
        for (const double g : scheme.parts) parts += (parts.empty() ? "" : ", ") + formatNumber(g, 15);
        add("composition", scheme.spec.composition.type + ", parts " + parts);
    }
    if (scheme.isTested())
        add("gives up", "the symplectic form: the defect of a step is C h^" +
                            std::to_string(scheme.discretization.space.integer("degree") * 2 + 1));
    if (scheme.spec.impact == ImpactLaw::variational)
        add("impacts", "with equal discrete energies on both sides");
    if (scheme.isMonitored()) {
        const std::string formula = scheme.spec.monitor.text("monitor");
        add("monitor", formula.empty() ? scheme.spec.monitor.type : formula);
    }
    if (scheme.isAdaptive())
        add("tolerance", formatNumber(scheme.spec.tolerance.value_or(0)));
    else
        add(scheme.isMonitored() ? "first step" : "step", formatNumber(scheme.spec.step.value));
    add("claims", claimsText(scheme.claims, *scene.system));
    add("caution", scheme.properties.shortfall);
    page.blocks.emplace_back(std::move(t));
}

void addAction(const ResolvedScheme& scheme, const System& system, Document& page) {
    if (!scheme.family) return;
    const auto* const onSystem = scheme.family->parts.find<WrittenOnSystem>();
    const bool isMonitored = scheme.isMonitored() && hasHamiltonian(system);
    const auto own =
        !onSystem     ? std::nullopt
        : isMonitored ? onSystem->written(scheme.discretization, monitoredKind(system, scheme.spec.monitor))
                      : onSystem->written(scheme.discretization, system);
    const auto* const test = scheme.isTested() ? scheme.family->parts.find<TestSpace>() : nullptr;
    const WrittenAction w = test  ? test->written(scheme.discretization, scheme.spec.keep)
                            : own ? *own
                                  : scheme.family->written(scheme.discretization);
    page.blocks.emplace_back(Document::Heading{test ? "The curve" : "The discrete action"});
    page.blocks.emplace_back(Document::Paragraph{w.meaning});
    if (isMonitored)
        page.blocks.emplace_back(Document::Paragraph{
            (isLogarithmic(scheme.spec.monitor)
                 ? std::string("Steps follow the potential: dt = dτ/(c − V) with equal steps dτ, c = 1/g_max "
                               "or 0. H below is K = log(T(p) − H₀ + c) − log(c − V(q)), ")
                 : std::string("Steps follow the monitor g: dt = g dτ with equal steps dτ. H below is K = "
                               "g(q, p) (H(q, p) − H₀), ")) +
            "with the time among the coordinates and −H₀, the energy at the start, as its momentum; h is dτ. "
            "Symplectic is the step in (t, q; −E, p)."});
    page.blocks.emplace_back(Document::Formulas{w.action});
    page.blocks.emplace_back(Document::Heading{test ? "What is kept" : "Stationarity"});
    page.blocks.emplace_back(Document::Formulas{w.stationarity});
}

void addStability(const ResolvedScheme& scheme, const Tableau* tableau, Document& page) {
    page.blocks.emplace_back(Document::Heading{"Stability"});
    if (tableau) addStabilityFunction(*tableau, page);
    const auto stability = stabilityOf(scheme);
    const auto say = [&](std::string text) {
        page.blocks.emplace_back(Document::Paragraph{std::move(text)});
    };
    if (!stability) return say("The largest stable step on the harmonic oscillator is not one number here.");
    const std::vector<UnstableInterval>& intervals = stability->intervals;
    if (intervals.empty()) return say("On the harmonic oscillator it is stable for every step.");
    const double limit = firstEdge(intervals);
    if (!(limit > 0)) return say("On the harmonic oscillator it is unstable for every short step.");
    say("On the harmonic oscillator of frequency ω it is stable for h ω up to " + formatNumber(limit, 8) +
        ".");
    if (!intervals.front().isBounded()) return;
    say("It is unstable for h ω from " + intervalsText(intervals) +
        ". A bounded interval is a resonance: it matters where the growth per step times the number of steps "
        "exceeds 1.");
}

}  // namespace

Document passportOf(const ResolvedScene& scene, std::size_t place, const PassportOptions& options,
                    const std::stop_token& stop) {
    const ResolvedScheme& scheme = scene.schemes[place];
    Document page;
    page.title = scheme.spec.label;
    addKind(scene, scheme, page);
    addAction(scheme, *scene.system, page);
    std::string reason;
    const auto tableau = tableauOf(scene, scheme, reason);
    if (tableau) {
        addStep(*tableau, page);
        addCoefficients(*tableau, page);
        addOrderConditions(*tableau, page);
        addStructure(*tableau, page);
    } else {
        page.blocks.emplace_back(Document::Heading{"Coefficients"});
        page.blocks.emplace_back(Document::Paragraph{reason});
    }
    addStability(scheme, tableau.get(), page);
    if (options.isMeasured) addMeasured(scene, place, options.threads, stop, page);
    return page;
}

}  // namespace extremal
