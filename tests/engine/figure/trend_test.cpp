// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/trend.hpp"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::trend_test {

using Series = std::vector<double>;

/// Draws series of a kind.
class Draw {
public:
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_()) / 0x1p32;
    }
    /// By the method of Box and Muller, so that the numbers are the same everywhere.
    double normal() {
        const double radius = std::sqrt(-2 * std::log(uniform(1e-12, 1)));
        return radius * std::cos(uniform(0, 2 * std::numbers::pi));
    }
    Series make(int n, const std::function<double(double)>& value) {
        Series s;
        for (int i = 0; i < n; ++i) s.push_back(value(static_cast<double>(i) / (n - 1)));
        return s;
    }
    /// A sine of some number of periods and any phase.
    std::function<double(double)> wave(double least, double most) {
        const double omega = 2 * std::numbers::pi * uniform(least, most),
                     phase = uniform(0, 2 * std::numbers::pi);
        return [=](double t) { return std::sin(omega * t + phase); };
    }

private:
    std::mt19937 engine_{7};
};

/// How often in 200 series of 1000 values each verdict was found.
struct Counts {
    int none = 0, drift = 0, open = 0;
};

constexpr int draws = 200, rows = 1000;

Counts countsOf(const std::function<Series(Draw&)>& kind) {
    Draw draw;
    Counts counts;
    for (int i = 0; i < draws; ++i) {
        const Trend trend = trendOf(kind(draw), 0);
        (trend == Trend::none ? counts.none : trend == Trend::drift ? counts.drift : counts.open) += 1;
    }
    return counts;
}

QByteArray words(const Counts& c) {
    return QString("none %1, drift %2, open %3").arg(c.none).arg(c.drift).arg(c.open).toLatin1();
}

class TrendTest : public QObject {
    Q_OBJECT

private slots:
    void whatFluctuatesDoesNotDrift() {
        const auto noise = countsOf([](Draw& d) { return d.make(rows, [&](double) { return d.normal(); }); });
        QVERIFY2(noise.none == draws, words(noise));
        const auto wave = countsOf([](Draw& d) { return d.make(rows, d.wave(20, 200)); });
        QVERIFY2(wave.none >= 0.85 * draws && wave.drift <= 0.015 * draws, words(wave));
        const auto modulated = countsOf([](Draw& d) {
            const double depth = d.uniform(0.2, 0.8);
            const auto slow = d.wave(5, 15), fast = d.wave(20, 200);
            return d.make(rows, [=](double t) { return (1 + depth * slow(t)) * fast(t); });
        });
        QVERIFY2(modulated.none >= 0.95 * draws && modulated.drift <= 0.015 * draws, words(modulated));
        const auto level = countsOf([](Draw& d) {
            const auto slow = d.wave(5, 15), fast = d.wave(20, 200);
            return d.make(rows, [=](double t) { return slow(t) + fast(t); });
        });
        QVERIFY2(level.none >= 0.95 * draws && level.drift <= 0.015 * draws, words(level));
        // Energy errors at passages near a centre.
        const auto peaks = countsOf([](Draw& d) {
            const auto turn = d.wave(8, 60);
            return d.make(rows, [=](double t) { return std::exp(30 * (turn(t) - 1)); });
        });
        QVERIFY2(peaks.none >= 0.9 * draws && peaks.drift <= 0.03 * draws, words(peaks));
    }
    void growthIsSeen() {
        const auto slow = countsOf([](Draw& d) {  // a line that ends at one standard deviation of the noise
            return d.make(rows, [&](double t) { return d.normal() + t; });
        });
        QVERIFY2(slow.drift >= 0.95 * draws && slow.open == 0, words(slow));
        const auto line = countsOf([](Draw& d) {
            const double rate = d.uniform(2, 30);
            return d.make(rows, [rate, wave = d.wave(20, 200)](double t) { return rate * t + wave(t); });
        });
        QVERIFY2(line.drift >= 0.97 * draws && line.none == 0, words(line));
        const auto square = countsOf([](Draw& d) {
            const double rate = d.uniform(3, 30);
            return d.make(rows, [rate, wave = d.wave(20, 200)](double t) { return rate * t * t + wave(t); });
        });
        QVERIFY2(square.drift >= 0.95 * draws && square.none == 0, words(square));
        const auto oscillation = countsOf(
            [](Draw& d) { return d.make(rows, [wave = d.wave(20, 200)](double t) { return t * wave(t); }); });
        QVERIFY2(oscillation.drift >= 0.95 * draws && oscillation.none == 0, words(oscillation));
        const auto explosion = countsOf([](Draw& d) {
            const double rate = d.uniform(2, 20);
            return d.make(rows,
                          [rate, wave = d.wave(20, 200)](double t) { return std::exp(rate * t) * wave(t); });
        });
        QVERIFY2(explosion.drift >= 0.97 * draws && explosion.none == 0, words(explosion));
    }
    void aChangeOfLevelIsNeverCalledSteady() {
        const auto decay = countsOf([](Draw& d) {
            const double size = d.uniform(5, 50), rate = d.uniform(2, 30);
            return d.make(rows, [=](double t) { return size * std::expm1(-rate * t); });
        });
        QVERIFY2(decay.drift == draws, words(decay));
        const auto waving = countsOf([](Draw& d) {  // how it goes on cannot be seen in the oscillation
            const double size = d.uniform(5, 50), rate = d.uniform(2, 30);
            return d.make(rows, [=, wave = d.wave(20, 200)](double t) {
                return size * std::expm1(-rate * t) + wave(t);
            });
        });
        QVERIFY2(waving.none == 0, words(waving));
        const auto jump = countsOf([](Draw& d) {
            const double at = d.uniform(0.2, 0.8), size = d.uniform(3, 30);
            return d.make(rows, [=, &d](double t) { return (t > at ? size : 0) + d.normal(); });
        });
        QVERIFY2(jump.open >= 0.85 * draws && jump.none == 0, words(jump));
    }
    void whereNothingCanBeSaidNothingIsSaid() {
        const auto single = countsOf([](Draw& d) {
            return d.make(rows, [=, once = d.wave(0.8, 1.2), wave = d.wave(20, 200)](double t) {
                return 5 * once(t) + wave(t);
            });
        });
        QVERIFY2(single.open == draws, words(single));
        const auto back = countsOf([](Draw& d) {  // from zero and back to it
            const double omega = 2 * std::numbers::pi * d.uniform(0.8, 1.2);
            return d.make(rows, [=](double t) { return 1 - std::cos(omega * t); });
        });
        QVERIFY2(back.open == draws, words(back));
        const auto walk = countsOf([](Draw& d) {
            double sum = 0;
            return d.make(rows, [&](double) { return sum += d.normal(); });
        });
        QVERIFY2(walk.open >= 0.75 * draws && walk.drift <= 0.15 * draws, words(walk));  // 161 and 25
        QVERIFY(trendOf(Series(31, 1.0), 0) == Trend::open);
        QVERIFY(trendOf({}, 0) == Trend::open);
        QVERIFY(trendOf(Series(100, std::numeric_limits<double>::quiet_NaN()), 0) == Trend::open);
    }
    void roundOffDoesNotDrift() {
        Draw draw;
        double sum = 0;
        const Series walk = draw.make(rows, [&](double) { return sum += 1e-16 * draw.normal(); });
        QVERIFY(trendOf(walk, 1e-13) == Trend::none);
        const Series line = draw.make(rows, [](double t) { return 1e-12 * t; });
        QVERIFY(trendOf(line, 1e-13) == Trend::drift);
        QVERIFY(trendOf(line, 1e-11) == Trend::none);
        QVERIFY(trendOf(Series(100, 0.0), 0) == Trend::none);
    }
    /// Of each scheme, by its energy error alone.
    void runsOfPresetsAreJudgedAsTheTheoryHasIt() {
        for (const char* preset : {"kepler", "charged-particle", "henon-heiles", "seed-spring", "pendulum"}) {
            const Comparison comparison = run(readScene(findPreset(preset)->json).scene);
            for (const auto& scheme : comparison.schemes) {
                if (scheme->summary.status == RunStatus::failed) continue;
                const bool drifts = scheme->spec.baseline.type == "rk4";
                const Trend trend = trendOf(scheme->trajectory["energy_error"], 1e-13);
                QVERIFY2(trend == (drifts ? Trend::drift : Trend::none),
                         (preset + (": " + scheme->spec.label)).c_str());
            }
        }
        // Once away from the perihelion and just coming back.
        Scene turn = readScene(findPreset("kepler")->json).scene;
        turn.end.value = 6;
        const Comparison once = run(turn);
        for (const auto& scheme : once.schemes)
            if (scheme->spec.baseline.type != "rk4")
                QVERIFY2(trendOf(scheme->trajectory["energy_error"], 1e-13) != Trend::drift,
                         scheme->spec.label.c_str());
    }
    void unitSignAndDirectionDoNotMatter() {
        Draw draw;
        const std::vector<Series> all = {draw.make(rows, [](double t) { return t * t; }),
                                         draw.make(rows, draw.wave(20, 40)), draw.make(rows, draw.wave(1, 1)),
                                         draw.make(rows, [&](double t) { return draw.normal() + 2 * t; })};
        for (const Series& series : all)
            for (const double unit : {1e-300, -1.0, 1e300}) {
                Series other = series;
                for (double& v : other) v *= unit;
                QCOMPARE(int(trendOf(other, 0)), int(trendOf(series, 0)));
                std::reverse(other.begin(), other.end());
                QCOMPARE(int(trendOf(other, 0)), int(trendOf(series, 0)));
            }
    }
    void notANumberDoesNotCountAndInfinityDoes() {
        Draw draw;
        Series wave = draw.make(rows, draw.wave(20, 20));
        wave[10] = std::numeric_limits<double>::quiet_NaN();
        QVERIFY(trendOf(wave, 0) == Trend::none);
        wave.back() = std::numeric_limits<double>::infinity();
        QVERIFY(trendOf(wave, 10) == Trend::drift);
    }
};

EXTREMAL_TEST(TrendTest)

}  // namespace extremal::trend_test

#include "trend_test.moc"
