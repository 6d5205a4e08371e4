// SPDX-License-Identifier: GPL-3.0-or-later
/// Everything for fields on intervals, alone and composed: what it claims, measured on a nonlinear field
/// around a circle. Orders are those of the mesh and the step, which are refined together.
#include <QTest>

#include <cmath>
#include <map>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/catalogue.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::claims_fields_test {
namespace {

constexpr double end = 1;

/// An odd number of cells, so that no rule leaves a wave without mass.
ResolvedScene fieldOn(const char* potential, int cells, const char* scheme) {
    const ReadScene read = readScene(
        R"({"extremal": 1, "model": {"type": "field", "domain": [0, "2*pi"], "boundary": "periodic", "potential": ")" +
        std::string(potential) + R"(", "cells": )" + std::to_string(cells) +
        R"(}, "initial": {"u": "1.2*cos(x) + 0.3*sin(2*x) ", "u_t": "0.5*sin(x) + 0.2"}, "time": {"end": 1},
            "schemes": [{"scheme": ")" +
        scheme + R"(", "step": 0.05}]})");
    if (!read.errors.empty()) qFatal("%s", read.errors.front().message.c_str());
    return *read.resolved;
}

/// At the end, by elements of degree 3 on a fine mesh.
const std::pair<std::shared_ptr<const System>, State>& truth() {
    static const auto known = [] {
        const ResolvedScene scene = fieldOn("sine-gordon", 291, "multisymplectic-3");
        const ResolvedScheme& scheme = scene.schemes[0];
        const auto integrator = scheme.make(*scheme.ownSystem, end / 240, scheme.ownInitial);
        const auto state = after(*integrator, scheme.ownInitial, 240);
        if (!state) qFatal("no reference");
        return std::pair{scheme.ownSystem, *state};
    }();
    return known;
}

double errorOf(const CatalogueScheme& c, const ResolvedScene& scene, int factor, long long steps) {
    const ResolvedScheme finer = refined(c.scheme, scene, factor);
    const auto integrator =
        finer.make(*finer.ownSystem, end / static_cast<double>(steps * factor), finer.ownInitial);
    const auto state = after(*integrator, finer.ownInitial, steps * factor);
    if (!state) return NAN;
    std::vector<double> exact(state->x.size());
    truth().first->at(truth().second.x.data(), finer.ownSystem->field.x, exact.data());
    double error = 0;
    finer.ownSystem->error.evaluate(state->x.data(), exact.data(), &error);
    return error;
}

/// Slope of the error over the finest meshes whose errors say something; NaN where there are fewer than two.
double orderOf(const CatalogueScheme& c, const ResolvedScene& scene, long long steps) {
    constexpr double lowest = 1e-8;
    std::vector<double> h, e;
    for (const int factor : {1, 2, 4, 8}) {
        const double error = errorOf(c, scene, factor, steps);
        if (!(error > lowest)) break;
        h.push_back(-std::log(factor));
        e.push_back(std::log(error));
    }
    while (h.size() > 2) {
        h.erase(h.begin());
        e.erase(e.begin());
    }
    return h.size() < 2 ? NAN : slope(h, e);
}

double relativeDistance(const State& a, const State& b) {
    double most = 0, size = 0;
    for (std::size_t i = 0; i < b.x.size(); ++i) {
        most = std::max(most, std::abs(a.x[i] - b.x[i]));
        size = std::max(size, std::abs(b.x[i]));
    }
    return most / size;
}

}  // namespace

class ClaimsFieldsTest : public QObject {
    Q_OBJECT
    const ResolvedScene scene_ = fieldOn("sine-gordon", 13, "multisymplectic-1"),
                        free_ = fieldOn("none", 13, "multisymplectic-1");
    std::map<std::string, CatalogueScheme> all_;

    const System& systemFor(const CatalogueScheme& c, const ResolvedScene& scene,
                            std::shared_ptr<const System>& own, State& start) const {
        const ResolvedScheme same = refined(c.scheme, scene, 1);
        own = same.ownSystem;
        start = same.ownInitial;
        return *own;
    }

private slots:
    void initTestCase() {
        for (const char* degree : {"1", "2", "3"}) {
            // The catalogue is asked on elements of each degree: a scheme fits one of them.
            const ResolvedScene on =
                fieldOn("sine-gordon", 13, (std::string("multisymplectic-") + degree).c_str());
            const ResolvedScheme& s = on.schemes[0];
            const System& system = s.ownSystem ? *s.ownSystem : *on.system;
            const State& start = s.ownSystem ? s.ownInitial : on.initial;
            for (CatalogueScheme& c : everythingOn(system, start, 0.05))
                // Spectral in space, where no mesh of this ladder is coarse: family.spectral_field and
                // family.free_motion.free_field.
                if (const std::string& space = c.scheme.discretization.space.type;
                    space != "fourier-field" && space != "free-motion")
                    all_.emplace(c.name, std::move(c));
        }
        QVERIFY2(all_.size() >= 40, qPrintable(QString::number(all_.size())));
    }
    void everyClaimHolds_data() {
        QTest::addColumn<QString>("name");
        for (const auto& [name, c] : all_) QTest::addRow("%s", name.c_str()) << QString::fromStdString(name);
    }
    void everyClaimHolds() {
        QFETCH(QString, name);
        const CatalogueScheme& c = all_.at(name.toStdString());
        const Claims& claims = c.claims();
        double order = NAN;
        for (const long long steps : {20, 5, 2, 1})  // of high orders longer ones, whose errors say something
            if (std::isnan(order)) order = orderOf(c, scene_, steps);
        std::shared_ptr<const System> own;
        State start;
        const System& system = systemFor(c, scene_, own, start);

        const auto there = after(*c.make(system, 0.06, start), start, 20);
        QVERIFY(there);
        State back = *there;
        back.node = 0;
        const auto home = after(*c.make(system, -0.06, back), back, 20);
        const double returned = home ? relativeDistance(*home, start) : NAN;

        double momentum = 0, form = NAN;
        {
            std::shared_ptr<const System> held;
            State state;
            const System& other = systemFor(c, free_, held, state);
            const auto integrator = c.make(other, 0.06, state);
            const double before = other.momenta.at(0).value(state.x.data(), state.x.data());
            integrator->begin(state);
            for (int k = 0; k < 30; ++k) QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
            momentum = std::abs(other.momenta.at(0).value(state.x.data(), state.x.data()) - before);
        }
        if (const Discretization* const d = c.scheme.plain()) {
            const auto integrator = c.make(system, 0.06, start);
            const Observer observer =
                findObservable("multisymplectic")->bind({system, start, {}, d, 0.06, {}});
            State state = start;
            integrator->begin(state);
            std::vector<double> values(observer.columns.size());
            form = 0;
            for (int k = 0; k <= 12; ++k) {
                observer.evaluate(state, {}, values.data());
                if (std::isfinite(values[0])) form = std::max(form, std::abs(values[0]));
                QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
            }
        }
        qInfo("order %.2f of %d, return %.1e, momentum %.1e, form %.1e", order, claims.order, returned,
              momentum, form);
        QVERIFY(std::isfinite(order));
        // Inside elements of degree 3 values are of order 5 only.
        QVERIFY2(order > claims.order - (claims.order >= 6 ? 1.2 : 0.5), "order");
        if (c.group == Group::named || c.group == Group::baseline)
            QVERIFY2(order < claims.order + 0.5, "better than claimed");
        if (claims.isSymmetric) QVERIFY2(returned < 1e-9, "does not return");
        if (claims.isOneStep && !claims.isSymmetric)
            QVERIFY2(returned > 1e-9, "returns, and does not claim it");
        if (c.claimsToConserve("momentum")) QVERIFY2(momentum < 1e-11, "momentum");
        if (c.claimsToConserve("multisymplectic form") && c.scheme.plain()) QVERIFY2(form < 1e-13, "form");
    }
};

EXTREMAL_TEST(ClaimsFieldsTest)
}  // namespace extremal::laws::claims_fields_test

#include "claims_fields_test.moc"
