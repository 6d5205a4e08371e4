// SPDX-License-Identifier: GPL-3.0-or-later
/// A recorded row of a run is a state: what a system says of a state reads and writes as many numbers as the
/// state has columns, and no more. Over the systems of all presets, and groups whose states are of odd size.
#include <QTest>

#include <cmath>
#include <limits>

#include "engine/model/system.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/tools/test.hpp"

namespace extremal::state_room_test {
namespace {

constexpr std::size_t beyond = 8;
constexpr double untouched = 0x1.23456p77;

std::vector<double> rowOf(const System& system, const State& state) {
    std::vector<double> row(state.x.begin(),
                            state.x.begin() + static_cast<std::ptrdiff_t>(stateColumns(system).size()));
    row.resize(row.size() + beyond, std::numeric_limits<double>::quiet_NaN());
    return row;
}

bool staysInside(const std::vector<double>& written) {
    return std::all_of(written.end() - beyond, written.end(), [](double v) { return v == untouched; });
}

/// What is wrong; empty if nothing is.
QString faultOf(const System& system, const State& state) {
    const std::size_t n = stateColumns(system).size();
    if (n == 0) return {};
    if (state.x.size() < n) return "the state is shorter than its columns";
    const std::vector<double> row = rowOf(system, state);
    std::vector<double> rate(n + beyond, untouched), whole(state.x.size() + beyond);
    if (rateOf(system, state.t, row.data(), rate.data())) {
        if (!staysInside(rate)) return "a rate is longer than a row";
        rateOf(system, state.t, state.x.data(), whole.data());
        if (!std::equal(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n), rate.begin()))
            return "a rate depends on what is behind a row";
    }
    if (const EnergyFunction energy = energyOf(system); energy) {
        const double known = energy(state.t, state.x.data());
        if (std::isfinite(known) && energy(state.t, row.data()) != known)
            return "the energy depends on what is behind a row";
    }
    const ErrorMeasure error = errorMeasure(system, state);
    if (error.evaluate) {
        std::vector<double> values(error.columns.size() + beyond, untouched);
        error.evaluate(row.data(), row.data(), values.data());
        if (!staysInside(values)) return "an error is longer than its columns";
        if (!std::all_of(values.begin(), values.end() - beyond, [](double v) { return std::isfinite(v); }))
            return "an error depends on what is behind a row";
    }
    return {};
}

}  // namespace

class StateRoomTest : public QObject {
    Q_OBJECT
private slots:
    void aRowIsAState() {
        int rates = 0;
        for (const Preset& preset : presets()) {
            const ReadScene read = readScene(preset.json);
            if (!read.resolved) continue;
            const QString fault = faultOf(*read.resolved->system, read.resolved->initial);
            QVERIFY2(fault.isEmpty(),
                     qPrintable(QString::fromStdString(std::string(preset.id)) + ": " + fault));
            std::vector<double> rate(read.resolved->initial.x.size() + beyond);
            rates += rateOf(*read.resolved->system, 0, read.resolved->initial.x.data(), rate.data());
            for (const ResolvedScheme& scheme : read.resolved->schemes) {
                if (!scheme.ownSystem) continue;
                const QString own = faultOf(*scheme.ownSystem, scheme.ownInitial);
                QVERIFY2(own.isEmpty(), qPrintable(QString::fromStdString(scheme.spec.label) + ": " + own));
            }
        }
        QVERIFY2(rates > 60, qPrintable(QString::number(rates)));
    }
    void groupsOfOddSize_data() {
        QTest::addColumn<QString>("group");
        for (const char* group : {"so3", "se2", "heisenberg", "sl2"}) QTest::newRow(group) << group;
    }
    void groupsOfOddSize() {
        QFETCH(QString, group);
        const std::string text = R"({"extremal": 1, "model": {"type": "group", "group": "GROUP",
            "lagrangian": "(xi1^2 + 2*xi2^2 + 3*xi3^2)/2"}, "time": {"end": 1},
            "schemes": [{"label": "a", "scheme": "lie-1", "step": 0.1}]})";
        const ReadScene read = readScene(QString::fromStdString(text).replace("GROUP", group).toStdString());
        QVERIFY(read.resolved);
        const QString fault = faultOf(*read.resolved->system, read.resolved->initial);
        QVERIFY2(fault.isEmpty(), qPrintable(fault));
    }
};

EXTREMAL_TEST(StateRoomTest)
}  // namespace extremal::state_room_test

#include "state_room_test.moc"
