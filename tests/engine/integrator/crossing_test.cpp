// SPDX-License-Identifier: GPL-3.0-or-later
/// Zeros of functions inside a step: how many there are, where, and what is not one.
#include <QTest>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "engine/integrator/crossing.hpp"
#include "tests/tools/test.hpp"

namespace extremal::crossing_test {
namespace {

constexpr double pi = std::numbers::pi;

/// A step on which x = tau.
class Straight final : public Integrator {
public:
    explicit Straight(double periods = 0) : periods_(periods) {}
    StepReport advance(State&, double) override { return {}; }
    void denseOutput(double tau, std::span<double> x) const override {
        ++calls;
        x[0] = tau;
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Straight>(*this); }
    double periodsPerStep() const override { return periods_; }

    mutable int calls = 0;

private:
    double periods_;
};

struct Found {
    std::vector<Crossing> all;
    int calls = 0;
};

Found find(const std::function<double(double)>& g, double periods = 0) {
    const Straight step(periods);
    StepSamples samples;
    samples.begin(step, 1);
    CrossingFinder finder;
    return {finder.find(g(0), g(1), samples.places(), [&](double tau) { return g(*samples.at(tau)); }),
            step.calls};
}

struct Case {
    const char* name;
    std::function<double(double)> g;
    std::vector<double> zeros;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all = {
        {"a straight line", [](double x) { return x - 0.37; }, {0.37}},
        {"at the later node", [](double x) { return x - 1; }, {1}},
        {"at the earlier node", [](double x) { return x; }, {}},
        {"three of a cubic", [](double x) { return (x - 0.1) * (x - 0.5) * (x - 0.6); }, {0.1, 0.5, 0.6}},
        {"three near each other",
         [](double x) { return (x - 0.4) * (x - 0.41) * (x - 0.42); },
         {0.4, 0.41, 0.42}},
        {"a short dip", [](double x) { return (x - 0.333) * (x - 0.3335) + 0 * x; }, {0.333, 0.3335}},
        {"a very short dip", [](double x) { return (x - 0.8) * (x - 0.8 - 1e-7); }, {0.8, 0.8 + 1e-7}},
        {"a dip in a curve",
         [](double x) { return std::hypot(20 * x - 10.3, 0.999) - 1; },
         {0.515 - std::sqrt(1 - 0.999 * 0.999) / 20, 0.515 + std::sqrt(1 - 0.999 * 0.999) / 20}},
        {"a dip near the node", [](double x) { return (x - 0.003) * (x - 0.011); }, {0.003, 0.011}},
        {"near both nodes", [](double x) { return (x - 0.002) * (x - 0.998); }, {0.002, 0.998}},
        {"a nearby miss", [](double x) { return (x - 0.333) * (x - 0.333) + 1e-9; }, {}},
        {"eight of a polynomial", [](double x) { return std::cos(8 * std::acos(2 * x - 1)); },
         [] {
             std::vector<double> zeros;
             for (int k = 7; k >= 0; --k) zeros.push_back((1 + std::cos(pi * (2 * k + 1) / 16)) / 2);
             return zeros;
         }()},
        {"a fast oscillation", [](double x) { return std::sin(50 * pi * x - 0.1); },
         [] {
             std::vector<double> zeros;
             for (int k = 0; k < 50; ++k) zeros.push_back((k + 0.1 / pi) / 50);
             return zeros;
         }()},
        {"the period of the samples", [](double x) { return std::sin(8 * pi * x + 0.3); },
         [] {
             std::vector<double> zeros;
             for (int k = 1; k <= 8; ++k) zeros.push_back((k - 0.3 / pi) / 8);
             return zeros;
         }()},
        {"a pole", [](double x) { return 1 / (x - 0.2); }, {}},
        {"a pole and a zero", [](double x) { return (x - 0.7) / (x - 0.2); }, {0.7}},
        {"a tangent", [](double x) { return std::tan(3 * x); }, {}},
        {"a cut", [](double x) { return std::atan2(x - 0.4, -1); }, {}},
        {"a cut and a zero",
         [](double x) { return std::remainder(7 * x - 0.5, 2 * pi); },
         {0.5 / 7, (2 * pi + 0.5) / 7}},
        {"a jump", [](double x) { return x < 0.3 ? -1.0 : 1.0; }, {}},
        {"a sign", [](double x) { return double((x > 0.5) - (x < 0.5)); }, {}},
        {"a small jump in a slope", [](double x) { return 10 * (x - 0.3) + (x < 0.3 ? -0.1 : 0.1); }, {}},
        {"a saw", [](double x) { return std::fmod(x + 0.1, 0.5) - 0.25; }, {0.15, 0.65}},
        {"a saw that begins above zero", [](double x) { return std::fmod(x + 0.26, 1.0) - 0.25; }, {0.99}},
        {"a root", [](double x) { return std::cbrt(x - 0.3); }, {0.3}},
        {"a kink", [](double x) { return std::abs(x - 0.3) - 0.01; }, {0.29, 0.31}},
        {"half a kink", [](double x) { return x < 0.3 ? x - 0.3 : 100 * (x - 0.3); }, {0.3}},
        {"steep", [](double x) { return std::tanh(1e5 * (x - 0.3)); }, {0.3}},
        {"not a number in a part", [](double x) { return std::log(x - 0.5) + 1; }, {0.5 + std::exp(-1.0)}},
        {"a zero beside such a part",
         [](double x) { return (x > 0.6 && x < 0.8 ? std::nan("") : 1) * (x - 0.3); },
         {0.3}},
    };
    return all;
}

}  // namespace

class CrossingTest : public QObject {
    Q_OBJECT
private slots:
    void everyZeroIsFoundAndNothingElse_data() {
        QTest::addColumn<int>("place");
        for (std::size_t i = 0; i < cases().size(); ++i)
            QTest::newRow(cases()[i].name) << static_cast<int>(i);
    }
    void everyZeroIsFoundAndNothingElse() {
        QFETCH(int, place);
        const Case& each = cases()[static_cast<std::size_t>(place)];
        // Upside down, and with other units: the same.
        for (const double factor : {1.0, -1.0, 1e-9, 1e9}) {
            const Found found = find([&](double x) { return factor * each.g(x); });
            std::string text;
            for (const Crossing& c : found.all) text += std::to_string(c.tau) + " ";
            QVERIFY2(found.all.size() == each.zeros.size(), text.c_str());
            for (std::size_t k = 0; k < each.zeros.size(); ++k) {
                // Measured: 3e-16, and 2e-9 where two zeros are 1e-7 apart.
                QVERIFY2(std::abs(found.all[k].tau - each.zeros[k]) < 1e-8, text.c_str());
                const double after = std::min(1.0, found.all[k].tau + 1e-8);
                if (after < 1) QCOMPARE(found.all[k].isUpwards, factor * each.g(after) > 0);
            }
        }
    }
    /// A function that bends little is looked at four times, and nothing more.
    void theCostIsThatOfTheSamples() {
        QCOMPARE(find([](double x) { return 5 + x; }).calls, 3);
        QCOMPARE(find([](double x) { return 5 + x * x; }).calls, 3);
        QVERIFY(find([](double x) { return x - 0.4; }).calls < 30);
        QVERIFY(find([](double x) { return std::sin(50 * pi * x) + 10; }).calls == 3);
    }
    /// Rounding is not resolved: it has no finest scale.
    void noiseIsNotResolved() {
        const Straight step;
        StepSamples samples;
        samples.begin(step, 1);
        CrossingFinder finder;
        int calls = 0;
        const auto g = [&](double tau) {
            ++calls;
            return 1e-16 * std::sin(1e9 * tau + 1);
        };
        const std::vector<double> state{1, -0.5};
        finder.find(g(0), g(1), samples.places(), g, roundingOf(state));
        QVERIFY2(calls < 200, qPrintable(QString::number(calls)));
    }
    void whatOscillatesInAStepIsResolved() {
        const Found found = find([](double x) { return std::sin(40 * pi * x - 0.1); }, 20);
        QCOMPARE(found.all.size(), std::size_t(40));
        QVERIFY(found.calls >= 319);
    }
    void placesFoundAreExact() {
        const Found found = find([](double x) { return std::exp(x) - 1.5; });
        QCOMPARE(found.all.size(), std::size_t(1));
        QVERIFY(std::abs(found.all[0].tau - std::log(1.5)) < 2e-16);  // measured: 5.6e-17
    }
};

EXTREMAL_TEST(CrossingTest)

}  // namespace extremal::crossing_test

#include "crossing_test.moc"
