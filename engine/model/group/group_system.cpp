// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/group_system.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/own_buffers.hpp"
#include "engine/group/so3.hpp"
#include "engine/model/casimir_measure.hpp"
#include "engine/model/group/group_flow.hpp"
#include "engine/model/group/group_symmetry.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/group/second_derivatives.hpp"
#include "engine/model/group/typed_group.hpp"
#include "engine/model/typed/phase/typed_variables.hpp"
#include "engine/model/typed/written_out.hpp"

namespace extremal::groups {
namespace {

using Vector = MatrixGroup::Vector;
using Matrix = MatrixGroup::Matrix;
using Entries = MatrixGroup::Entries;

std::string inFront(const MatrixGroup::Factor& f) { return f.name.empty() ? "" : f.name + "."; }
std::string titled(const MatrixGroup::Factor& f, const std::string& what) {
    return f.name.empty() ? what : what + " of " + f.name;
}

std::vector<Quantity> columnsOf(const MatrixGroup& group) {
    std::vector<Quantity> columns;
    for (const MatrixGroup::Factor& f : group.factors())
        for (int i = 0; i < f.n; ++i)
            for (int j = 0; j < f.n; ++j) {
                const std::string at = std::to_string(i + 1) + (f.n > 9 ? "." : "") + std::to_string(j + 1);
                columns.push_back({inFront(f) + "g." + at, titled(f, "entry " + at), titled(f, "g_" + at), ""});
            }
    for (const auto& [name, title, symbol] :
         {std::tuple{"mu.", "body momentum ", "μ_"}, {"momentum.space.", "space momentum ", "J_"}})
        for (const MatrixGroup::Factor& f : group.factors())
            for (int a = 0; a < f.d; ++a) {
                const std::string at = std::to_string(a + 1);
                const bool isSpace = std::string(name).starts_with("momentum");
                columns.push_back({isSpace ? name + inFront(f) + at : inFront(f) + name + at,
                                   titled(f, title + at), titled(f, symbol + at), ""});
            }
    return columns;
}

struct Place {
    const double *g, *mu, *J;
    Place(const GroupMechanics& on, const double* x)
        : g(x), mu(x + on.group->entries()), J(mu + on.dimension()) {}
};

/// eta; not a number where there is none.
Vector velocityAt(const GroupMechanics& on, const Place& at) {
    Vector eta(on.dimension());
    if (!on.velocity(on.model.get(), at.g, at.mu, eta.data())) eta.setConstant(std::nan(""));
    return eta;
}

/// Room of one thread for evaluations of a rate.
struct RateRoom {
    explicit RateRoom(const GroupMechanics& on)
        : m(on.dimension()), f(Vector::Zero(on.dimension())), eta(m) {}
    Vector m, f, eta, J;
    Entries g;
};

/// g' = g hat eta, mu' = ad_eta^T mu + f, J' = Ad_{g^-1}^T f.
bool rate(const GroupMechanics& on, long long id, const double* x, double* dx) {
    const MatrixGroup& group = *on.group;
    RateRoom& own = ownBuffers<RateRoom>(id, on);
    const Place at(on, x);
    const int d = group.dimension(), n = group.entries();
    if (!on.velocity(on.model.get(), at.g, at.mu, own.eta.data())) own.eta.setConstant(std::nan(""));
    const Eigen::Map<const Entries> g(at.g, n);
    group.rate(g, own.eta, own.g);
    Eigen::Map<Entries>(dx, n) = own.g;
    std::fill(dx + n + d, dx + on.stateSize(), 0.0);  // what fills a state up to an even size has no rate
    double value = 0;
    if (!on.isInvariant) {
        on.gradient(on.model.get(), at.g, own.eta.data(), &value, own.m.data(), own.f.data());
        group.inSpace(g, own.f, own.J);
        Eigen::Map<Vector>(dx + n + d, d) = own.J;
    }
    for (const MatrixGroup::Factor& f : group.factors()) {
        const auto part = [&](const Vector& of) -> GroupFactor::Vector {
            return of.segment(f.coordinate, f.d);
        };
        const GroupFactor::Vector mu = Eigen::Map<const Vector>(at.mu, d).segment(f.coordinate, f.d);
        Eigen::Map<Vector>(dx + n + f.coordinate, f.d) =
            f.constants.coadjoint(part(own.eta), mu) + part(own.f);
    }
    return own.eta.allFinite();
}

double energyAt(const GroupMechanics& on, const double* x) {
    const Place at(on, x);
    const Vector eta = velocityAt(on, at);
    Vector m(on.dimension());
    double value = 0;
    on.gradient(on.model.get(), at.g, eta.data(), &value, m.data(), nullptr);
    return eta.dot(Eigen::Map<const Vector>(at.mu, on.dimension())) - value;
}

/// How fast the frame turns, or swings: the larger.
double frequencyAt(const GroupMechanics& on, const double* x) {
    const Place at(on, x);
    const Vector eta = velocityAt(on, at);
    const double turning = on.group->adNorm(eta);
    if (on.isInvariant) return turning;
    const SecondDerivatives second(on, at.g, eta);
    const double swinging = std::sqrt(second.largestRatio({}));
    return std::isfinite(swinging) ? std::max(turning, swinging) : turning;
}

bool isRotation(const GroupMechanics& on) {
    return on.group->factors().size() == 1 && on.group->entries() == 9 && on.invariants->isOrthogonal(0);
}

ErrorMeasure errorOf(const GroupMechanics& on) {
    ErrorMeasure m;
    const int n = on.group->entries(), d = on.dimension();
    const auto momentum = [n, d](const double* x, const double* reference) {
        return (Eigen::Map<const Vector>(x + n, d) - Eigen::Map<const Vector>(reference + n, d)).norm();
    };
    if (isRotation(on)) {
        m.isOfPhase = true;
        m.columns = {{"error", "", "∠(g, g_ref)", "rad"}, {"error.p", "", "|μ - μ_ref|", ""}};
        m.evaluate = [momentum](const double* x, const double* reference, double* values) {
            using Square = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
            const so3::Matrix<double> turn = Square(reference).transpose() * Square(x);
            values[0] = so3::log(turn).norm();
            values[1] = momentum(x, reference);
        };
        return m;
    }
    m.columns = {{"error", "", "|(g, μ) - ref|", ""},
                 {"error.g", "", "|g - g_ref|", ""},
                 {"error.p", "", "|μ - μ_ref|", ""}};
    m.evaluate = [momentum, n](const double* x, const double* reference, double* values) {
        values[1] = (Eigen::Map<const Entries>(x, n) - Eigen::Map<const Entries>(reference, n)).norm();
        values[2] = momentum(x, reference);
        values[0] = std::hypot(values[1], values[2]);
    };
    return m;
}

/// "upper.2" of the flat index of a coordinate.
std::string coordinateName(const MatrixGroup& group, int index) {
    const auto& factors = group.factors();
    const auto f = std::find_if(factors.rbegin(), factors.rend(),
                                [&](const MatrixGroup::Factor& each) { return each.coordinate <= index; });
    return inFront(*f) + std::to_string(index - f->coordinate + 1);
}

void describeKept(System& system, const GroupMechanics& on) {
    const int from = on.group->entries() + on.dimension();
    const Eigen::MatrixXd kept = keptDirections(on);
    int combinations = 0;
    for (Eigen::Index k = 0; k < kept.cols(); ++k) {
        const Eigen::VectorXd zeta = kept.col(k);
        Eigen::Index one = 0;
        zeta.cwiseAbs().maxCoeff(&one);
        const bool isOne = (zeta.array() != 0).count() == 1;
        const std::string name = isOne ? "space." + coordinateName(*on.group, static_cast<int>(one))
                                       : "combination." + std::to_string(++combinations);
        system.momenta.push_back(
            {name, isOne ? "J_" + coordinateName(*on.group, static_cast<int>(one)) : "J·ζ", "",
             [zeta, from](const double* x, const double*) {
                 return zeta.dot(Eigen::Map<const Eigen::VectorXd>(x + from, zeta.size()));
             }});
    }
    if (!on.isInvariant) return;
    const std::vector<Casimir> forms = quadraticCasimirs(*on.group);
    if (forms.empty()) return;
    std::vector<Quantity> columns;
    for (std::size_t k = 0; k < forms.size(); ++k)
        columns.push_back({k == 0 ? "casimir" : "casimir." + std::to_string(k + 1), "",
                           k == 0 ? "C" : "C_" + std::to_string(k + 1), ""});
    system.measures.push_back(casimirMeasure(
        std::move(columns), [forms, n = on.group->entries()](double, const double* x, double* values) {
            for (const auto& [coordinate, Q] : forms) {
                const Eigen::Map<const Eigen::VectorXd> mu(x + n + coordinate, Q.rows());
                *values++ = mu.dot(Q * mu);
            }
        }));
}

void describeColumns(System& system, const GroupMechanics& on) {
    system.columns = columnsOf(*on.group);
    const auto momentum = static_cast<std::size_t>(on.group->entries());
    const auto d = static_cast<std::size_t>(on.dimension());
    system.phaseX = system.columns[momentum].name;
    system.phaseY = system.columns[d > 1 ? momentum + 1 : 0].name;
    system.trajectoryX = "t";
    system.trajectoryY = system.columns[0].name;
    for (std::size_t k = 0; k < std::min<std::size_t>(d, 3); ++k)
        system.timePlots.push_back(system.columns[momentum + k].name);
}

}  // namespace

System systemOf(const Settings& settings) {
    const GroupMechanics on = mechanicsOf(settings);
    System s;
    s.id = "group";
    s.parts.set(LieGroup{std::make_shared<const GroupMechanics>(on)});
    describeColumns(s, on);
    s.error = errorOf(on);
    s.energy = [on](double, const double* x) { return energyAt(on, x); };
    s.kineticEnergy = [on](double, const double* x) {
        const Place at(on, x);
        return velocityAt(on, at).dot(Eigen::Map<const Vector>(at.mu, on.dimension())) / 2;
    };
    s.rate = [on, id = nextModelId()](double, const double* x, double* dx) { return rate(on, id, x, dx); };
    s.frequency = [on](double, const double* x) { return frequencyAt(on, x); };
    s.start = [on, parameters = typed::parametersOf(settings)](const Settings& initial, double) {
        return startOf(on, typed::startWrittenOut(initial, parameters));
    };
    s.measures.push_back({"group-distance",
                          {{"group-distance", "", "|g - G|", ""}},
                          0,
                          [on](const State&) -> Measure::Evaluate {
                              return [on](double, const double* x, double* values) {
                                  values[0] = on.invariants->distance(
                                      Eigen::Map<const Entries>(x, on.group->entries()));
                              };
                          }});
    describeKept(s, on);
    describePicture(s, on);
    s.parts.set(byHand(on));
    return s;
}

}  // namespace extremal::groups
