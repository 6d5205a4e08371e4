// SPDX-License-Identifier: GPL-3.0-or-later
/// Two adaptive integrators as an expert writes them by hand for x'' = f(x), with the number of coordinates
/// known to the compiler: DOP853 (Hairer, Norsett, Wanner 1993, II.5 and II.10, and the code dop853.f that
/// belongs to the book: 12 stages, order 8, its error from formulas of orders 5 and 3) and IAS15 (Rein and
/// Spiegel 2015, MNRAS 446, 1424; Everhart 1985: Gauss-Radau of order 15 with 8 nodes).
///
/// Both work on positions, then velocities, call `accelerate(const double* x, double* a)` and say whether
/// they have come to the end, which their last step meets.
#pragma once

#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/bench/taylor.hpp"

namespace extremal::bench {

/// Of an adaptive run: coarse ones may end in a collision.
inline constexpr int mostSteps = 1'000'000;

namespace dop853 {

using Row = std::array<double, 12>;
/// Stages 0 to 11, then the step of order 8 and the two estimates: of order 5, and the step less that of
/// order 3. The nodes of the stages are not needed without explicit time.
inline constexpr std::array<Row, 15> table{
    {{},
     {5.26001519587677318785587544488e-2},
     {1.97250569845378994544595329183e-2, 5.91751709536136983633785987549e-2},
     {2.95875854768068491816892993775e-2, 0, 8.87627564304205475450678981324e-2},
     {2.41365134159266685502369798665e-1, 0, -8.84549479328286085344864962717e-1,
      9.24834003261792003115737966543e-1},
     {3.7037037037037037037037037037e-2, 0, 0, 1.70828608729473871279604482173e-1,
      1.25467687566822425016691814123e-1},
     {3.7109375e-2, 0, 0, 1.70252211019544039314978060272e-1, 6.02165389804559606850219397283e-2,
      -1.7578125e-2},
     {3.70920001185047927108779319836e-2, 0, 0, 1.70383925712239993810214054705e-1,
      1.07262030446373284651809199168e-1, -1.53194377486244017527936158236e-2,
      8.27378916381402288758473766002e-3},
     {6.24110958716075717114429577812e-1, 0, 0, -3.36089262944694129406857109825,
      -8.68219346841726006818189891453e-1, 2.75920996994467083049415600797e1,
      2.01540675504778934086186788979e1, -4.34898841810699588477366255144e1},
     {4.77662536438264365890433908527e-1, 0, 0, -2.48811461997166764192642586468,
      -5.90290826836842996371446475743e-1, 2.12300514481811942347288949897e1,
      1.52792336328824235832596922938e1, -3.32882109689848629194453265587e1,
      -2.03312017085086261358222928593e-2},
     {-9.3714243008598732571704021658e-1, 0, 0, 5.18637242884406370830023853209,
      1.09143734899672957818500254654, -8.14978701074692612513997267357, -1.85200656599969598641566180701e1,
      2.27394870993505042818970056734e1, 2.49360555267965238987089396762, -3.0467644718982195003823669022},
     {2.27331014751653820792359768449, 0, 0, -1.05344954667372501984066689879e1,
      -2.00087205822486249909675718444, -1.79589318631187989172765950534e1, 2.79488845294199600508499808837e1,
      -2.85899827713502369474065508674, -8.87285693353062954433549289258, 1.23605671757943030647266201528e1,
      6.43392746015763530355970484046e-1},
     {5.42937341165687622380535766363e-2, 0, 0, 0, 0, 4.45031289275240888144113950566,
      1.89151789931450038304281599044, -5.8012039600105847814672114227, 3.1116436695781989440891606237e-1,
      -1.52160949662516078556178806805e-1, 2.01365400804030348374776537501e-1,
      4.47106157277725905176885569043e-2},
     {0.1312004499419488073250102996e-1, 0, 0, 0, 0, -0.1225156446376204440720569753e1,
      -0.4957589496572501915214079952, 0.1664377182454986536961530415e1, -0.3503288487499736816886487290,
      0.3341791187130174790297318841, 0.8192320648511571246570742613e-1, -0.2235530786388629525884427845e-1},
     {5.42937341165687622380535766363e-2 - 0.244094488188976377952755905512, 0, 0, 0, 0,
      4.45031289275240888144113950566, 1.89151789931450038304281599044, -5.8012039600105847814672114227,
      3.1116436695781989440891606237e-1 - 0.733846688281611857341361741547,
      -1.52160949662516078556178806805e-1, 2.01365400804030348374776537501e-1,
      4.47106157277725905176885569043e-2 - 0.220588235294117647058823529412e-1}}};

template <std::size_t d, class Accelerate>
class Motion {
public:
    using Array = std::array<double, 2 * d>;

    Motion(const Accelerate& accelerate, double tolerance) : accelerate_(accelerate), tolerance_(tolerance) {}

    /// `step` not 0: all steps are this one.
    bool run(Array& y, double end, double step) {
        derive(y, k_[0]);
        double h = step > 0 ? step : firstStep(y);
        bool isRejected = false;
        int steps = 0;
        for (double t = 0; t < end;) {
            if (++steps > mostSteps) return false;
            const bool isLast = t + 1.01 * h >= end;
            if (isLast) h = end - t;
            stages(h, y, std::make_index_sequence<11>());
            const double error = step > 0 ? 0 : endOfStep(h, y);
            if (step > 0) endOfStep(h, y);
            // dop853.f: safety 0.9, factors between 1/3 and 6, no stabilization.
            const double power = std::pow(error, 1.0 / 8),
                         factor = std::clamp(power / 0.9, 1.0 / 6, 1 / 0.333);
            if (error <= 1) {
                y = stage_;
                derive(y, k_[0]);
                t = isLast ? end : t + h;
                if (step == 0) h = isRejected ? std::min(h, h / factor) : h / factor;
                isRejected = false;
            } else {
                h /= std::min(1 / 0.333, power / 0.9);
                isRejected = true;
                if (!(h > 1e-15 * end)) return false;
            }
        }
        return true;
    }

private:
    void derive(const Array& y, Array& dy) const {
        std::copy_n(y.begin() + d, d, dy.begin());
        accelerate_(y.data(), dy.data() + d);
    }
    template <std::size_t row, std::size_t term = 0>
    double sum(std::size_t i) const {
        if constexpr (term == 12)
            return 0;
        else if constexpr (table[row][term] == 0)
            return sum<row, term + 1>(i);
        else
            return table[row][term] * k_[term][i] + sum<row, term + 1>(i);
    }
    template <std::size_t row>
    void place(double h, const Array& y) {
        for (std::size_t i = 0; i < 2 * d; ++i) stage_[i] = y[i] + h * sum<row>(i);
    }
    template <std::size_t... s>
    void stages(double h, const Array& y, std::index_sequence<s...>) {
        ((place<s + 1>(h, y), derive(stage_, k_[s + 1])), ...);
    }
    double scale(double a, double b) const {
        return tolerance_ + tolerance_ * std::max(std::abs(a), std::abs(b));
    }
    /// The end to stage_, and the error in units of the tolerance.
    double endOfStep(double h, const Array& y) {
        place<12>(h, y);
        double five = 0, three = 0;
        for (std::size_t i = 0; i < 2 * d; ++i) {
            const double unit = 1 / scale(y[i], stage_[i]), a = sum<13>(i) * unit, b = sum<14>(i) * unit;
            five += a * a;
            three += b * b;
        }
        const double all = five + 0.01 * three;
        return all > 0 ? h * five / std::sqrt(all * static_cast<double>(2 * d)) : all == 0 ? 0 : HUGE_VAL;
    }
    /// hinit of dop853.f: by an Euler step.
    double firstStep(const Array& y) {
        double size = 0, slope = 0, change = 0;
        for (std::size_t i = 0; i < 2 * d; ++i) {
            const double unit = 1 / scale(y[i], 0);
            size += std::pow(y[i] * unit, 2);
            slope += std::pow(k_[0][i] * unit, 2);
        }
        double h = size <= 1e-10 || slope <= 1e-10 ? 1e-6 : 0.01 * std::sqrt(size / slope);
        for (std::size_t i = 0; i < 2 * d; ++i) stage_[i] = y[i] + h * k_[0][i];
        derive(stage_, k_[1]);
        for (std::size_t i = 0; i < 2 * d; ++i) change += std::pow((k_[1][i] - k_[0][i]) / scale(y[i], 0), 2);
        const double most = std::max(std::sqrt(slope), std::sqrt(change) / h);
        return std::min(100 * h, most > 1e-15 ? std::pow(0.01 / most, 1.0 / 8) : 1e-3 * h);
    }

    const Accelerate& accelerate_;
    double tolerance_;
    std::array<Array, 12> k_;
    Array stage_;
};

}  // namespace dop853

/// To the time `end`, with the tolerance absolute and relative; with `step` in equal steps.
template <std::size_t d, class Accelerate>
bool integrateByDop853(std::array<double, 2 * d>& y, double end, double tolerance,
                       const Accelerate& accelerate, double step = 0) {
    return dop853::Motion<d, Accelerate>(accelerate, tolerance).run(y, end, step);
}

namespace ias15 {

/// The nodes in (0, 1], 0 being one as well, of Gauss and Radau, and what follows from them: of Newton's form
/// g_k s (s - h_1) ... (s - h_k) in powers b_j s^(j+1), b_j = sum_k powers[k][j] g_k; and binomials.
struct Tables {
    std::array<double, 8> h{0,
                            0.0562625605369221464656521910318,
                            0.180240691736892364987579942780,
                            0.352624717113169637373907769648,
                            0.547153626330555383001448554766,
                            0.734210177215410531523210605558,
                            0.885320946839095768090359771030,
                            0.977520613561287501891174488626};
    std::array<std::array<double, 7>, 7> powers{}, binomials{};
    std::array<std::array<double, 8>, 8> inverse{};  ///< 1/(h_n - h_k), k < n

    constexpr Tables() {
        for (std::size_t k = 0; k < 7; ++k)
            for (std::size_t j = 0; j <= k; ++j) {
                if (k == 0)
                    powers[k][j] = 1;
                else
                    powers[k][j] = (j > 0 ? powers[k - 1][j - 1] : 0) - h[k] * (j < k ? powers[k - 1][j] : 0);
                binomials[k][j] = 1;  // k + 1 over j + 1
                for (std::size_t i = 0; i <= j; ++i)
                    binomials[k][j] *= static_cast<double>(k + 1 - i) / static_cast<double>(i + 1);
            }
        for (std::size_t n = 0; n < 8; ++n)
            for (std::size_t k = 0; k < n; ++k) inverse[n][k] = 1 / (h[n] - h[k]);
    }
};
inline constexpr Tables tables;

template <std::size_t d, class Accelerate>
class Motion {
public:
    using Places = std::array<double, d>;
    Motion(const Accelerate& accelerate, double accuracy) : accelerate_(accelerate), accuracy_(accuracy) {}

    /// `step` not 0: all steps are this one.
    bool run(std::array<double, 2 * d>& y, double end, double epsilon, double step) {
        std::copy_n(y.begin(), d, x_.begin());
        std::copy_n(y.begin() + d, d, v_.begin());
        accelerate_(x_.data(), a_.data());
        double dt = step > 0 ? step : 0.1 * std::sqrt(largest(x_) / largest(a_));
        int steps = 0;
        for (double t = 0; t < end;) {
            if (++steps > mostSteps) return false;
            const bool isLast = t + dt * (1 + 1e-12) >= end;
            const double h = isLast ? end - t : dt;
            predict(h);
            iterate(h);
            // Hardly more than a quarter is another step, four times as much the most.
            const double size = largest(b_[6]) / largest(at_);
            const double factor = size > 0 ? std::pow(epsilon / size, 1.0 / 7) : size == 0 ? 4 : 0;
            if (step == 0) dt = h * std::min(factor, 4.0);
            if (step == 0 && factor < 0.25) {
                if (!(dt > 1e-12 * end)) return false;
                continue;
            }
            advance(h);
            accelerate_(x_.data(), a_.data());
            t = isLast ? end : t + h;
        }
        std::copy_n(x_.begin(), d, y.begin());
        std::copy_n(v_.begin(), d, y.begin() + d);
        return true;
    }

private:
    static double largest(const Places& of) {
        double most = 0;
        for (const double each : of) most = std::max(most, std::abs(each));
        return most;
    }
    static void addTo(double& sum, double& lost, double more) {
        const double wanted = more - lost, total = sum + wanted;
        lost = (total - sum) - wanted;
        sum = total;
    }
    /// b of a step h from those of the step before, and the correction that these had needed.
    void predict(double h) {
        const double q = last_ > 0 ? h / last_ : HUGE_VAL;
        if (q > 20) {
            b_ = expected_ = {};
        } else {
            std::array<double, 7> scale;
            for (std::size_t j = 0; j < 7; ++j) scale[j] = (j > 0 ? scale[j - 1] : 1) * q;
            for (std::size_t i = 0; i < d; ++i)
                for (std::size_t j = 0; j < 7; ++j) {
                    double sum = 0;
                    for (std::size_t k = j; k < 7; ++k) sum += tables.binomials[k][j] * done_[k][i];
                    expected_[j][i] = scale[j] * sum;
                    b_[j][i] = expected_[j][i] + correction_[j][i];
                }
        }
        // Newton's form of these.
        for (std::size_t i = 0; i < d; ++i)
            for (std::size_t k = 7; k-- > 0;) {
                double g = b_[k][i];
                for (std::size_t m = k + 1; m < 7; ++m) g -= tables.powers[m][k] * g_[m][i];
                g_[k][i] = g;
            }
    }
    /// Node by node, as long as the last coefficient changes.
    void iterate(double h) {
        double before = HUGE_VAL;
        for (int iteration = 0; iteration < 12; ++iteration) {
            atNodes(h, std::make_index_sequence<7>());
            const double change = largest(change_) / largest(at_);
            if (!(change > accuracy_) || (iteration > 1 && change >= before)) break;
            before = change;
        }
    }
    template <std::size_t... n>
    void atNodes(double h, std::index_sequence<n...>) {
        (atNode<n + 1>(h), ...);
    }
    template <std::size_t n>
    void atNode(double h) {
        constexpr double s = tables.h[n];
        for (std::size_t i = 0; i < d; ++i) place_[i] = x_[i] + (way(i, s, h) - lostX_[i]);
        accelerate_(place_.data(), at_.data());
        for (std::size_t i = 0; i < d; ++i) {
            double g = (at_[i] - a_[i]) * tables.inverse[n][0];
            for (std::size_t k = 1; k < n; ++k) g = (g - g_[k - 1][i]) * tables.inverse[n][k];
            const double more = g - g_[n - 1][i];
            g_[n - 1][i] = g;
            for (std::size_t j = 0; j < n; ++j) b_[j][i] += tables.powers[n - 1][j] * more;
            if constexpr (n == 7) change_[i] = more;
        }
    }
    /// From the start of the step to its part s.
    double way(std::size_t i, double s, double h) const {
        double sum = 0;
        for (std::size_t j = 7; j-- > 0;)
            sum = s * (sum + b_[j][i] * (1.0 / static_cast<double>((j + 2) * (j + 3))));
        return s * h * (v_[i] + s * h * (a_[i] / 2 + sum));
    }
    void advance(double h) {
        for (std::size_t i = 0; i < d; ++i) {
            double sum = 0;
            for (std::size_t j = 7; j-- > 0;) sum += b_[j][i] / static_cast<double>(j + 2);
            addTo(x_[i], lostX_[i], way(i, 1, h));
            addTo(v_[i], lostV_[i], h * (a_[i] + sum));
            for (std::size_t j = 0; j < 7; ++j)
                correction_[j][i] = last_ > 0 ? b_[j][i] - expected_[j][i] : 0;
        }
        done_ = b_;
        last_ = h;
    }

    const Accelerate& accelerate_;
    double accuracy_, last_ = 0;
    Places x_, v_, a_, at_, place_, change_, lostX_{}, lostV_{};
    std::array<Places, 7> b_{}, g_{}, expected_{}, correction_{}, done_{};
};

}  // namespace ias15

/// To the time `end`; epsilon 1e-9 is the setting of the paper, 1e-16 its accuracy of the iteration.
template <std::size_t d, class Accelerate>
bool integrateByIas15(std::array<double, 2 * d>& y, double end, double epsilon, const Accelerate& accelerate,
                      double accuracy = 1e-16, double step = 0) {
    return ias15::Motion<d, Accelerate>(accelerate, accuracy).run(y, end, epsilon, step);
}

/// A motion as adaptive codes take it.
template <std::size_t d>
struct AdaptiveRuns {
    const System& system;
    const State& from;
    std::array<double, 2 * d> start;  ///< positions, velocities
    double end;
    std::vector<double> tolerances;
    std::vector<double> epsilons = ratios(1e-1, 1e-10, 0.5);  ///< of IAS15
};

/// The curves of all adaptive peers; IAS15 as it is published, and with iterations only to 1e-9.
/// `coefficients` as for integrateByTaylor, `error(x)` as for measure().
template <std::size_t d, class Accelerate, class Coefficients, class Error>
void addAdaptivePeers(Curves& curves, const AdaptiveRuns<d>& of, const Accelerate& accelerate,
                      Coefficients coefficients, const Error& error) {
    namespace odeint = boost::numeric::odeint;
    using Array = std::array<double, 2 * d>;
    const auto byOdeint = [&](const auto& stepper) {
        Array y = of.start;
        odeint::integrate_adaptive(
            stepper,
            [&](const Array& x, Array& dx, double) {
                for (std::size_t i = 0; i < d; ++i) dx[i] = x[d + i];
                accelerate(x.data(), dx.data() + d);
            },
            y, 0.0, of.end, 1e-4 * of.end);
        return error(y);
    };
    curves.add("odeint rkf78", true, of.tolerances, [&](double e) {
        return byOdeint(odeint::make_controlled(e, e, odeint::runge_kutta_fehlberg78<Array>()));
    });
    curves.add("odeint bulirsch-stoer", true, of.tolerances,
               [&](double e) { return byOdeint(odeint::bulirsch_stoer<Array>(e, e)); });
    curves.add("rk8pd", true, of.tolerances, [&](double e) {
        const auto integrator = baselineOf("rk8pd")(of.system, of.from, e);
        State state = of.from;
        while (state.t < of.end)
            if (integrator->advance(state, of.end).outcome != Outcome::converged) return failed;
        return error(state.x);
    });
    curves.add("Taylor by hand", true, of.tolerances, [&](double e) {
        Array y = of.start;
        integrateByTaylor<d>(y, of.end, e, coefficients);
        return error(y);
    });
    curves.add("DOP853", true, of.tolerances, [&](double e) {
        Array y = of.start;
        return integrateByDop853<d>(y, of.end, e, accelerate) ? error(y) : failed;
    });
    for (const double accuracy : {1e-16, 1e-9})
        curves.add(std::string("IAS15") + (accuracy > 1e-12 ? " to 1e-9" : ""), true, of.epsilons,
                   [&](double epsilon) {
                       Array y = of.start;
                       return integrateByIas15<d>(y, of.end, epsilon, accelerate, accuracy) ? error(y)
                                                                                            : failed;
                   });
}

}  // namespace extremal::bench
