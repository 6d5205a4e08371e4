// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/typed_mechanics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/elimination.hpp"
#include "engine/core/algebra/instruction_set.hpp"
#include "engine/model/typed/branches.hpp"
#include "engine/model/typed/landmarks.hpp"
#include "engine/model/typed/tape/node_tape.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape/tape_kicks.hpp"
#include "engine/model/typed/tape/tape_registers.hpp"
#include "engine/model/typed/tape/tape_run.hpp"

namespace extremal::typed {
namespace {

/// Everything the calls need; immutable once made.
struct Model {
    int d = 0;
    bool isQuadratic = false;                              ///< in v
    bool isDiagonal = false;                               ///< L_vv
    Tape value, gradient, force, jet, hessians, legendre;  ///< hessians: the outputs of `places` alone
    std::vector<double> masses;                            ///< separable
    KickTape kicks;                                        ///< separable, and the time is not known
    /// Its constant entries in place; empty where there are many coordinates.
    std::vector<double> hessian;
    struct Constant {
        std::size_t at, mirrored;
        double value;
    };
    std::vector<Constant> constants;  ///< those that are not 0
    struct Place {
        std::size_t output, at, mirrored;  ///< output of the jet's tape -> two entries of the Hessian
    };
    std::vector<Place> places;
    Landmarks landmarks;
    std::shared_ptr<const Branches> branches;
};

const Model& self(const void* p) { return *static_cast<const Model*>(p); }

/// One evaluation of a tape at (t, q, v); v may be null for what does not depend on it.
class Registers : public TapeRegisters {
public:
    Registers(const Model& m, const Tape& tape, double t, const double* q, const double* v)
        : TapeRegisters(tape, [&](double* r) {
              const auto d = static_cast<std::size_t>(m.d);
              std::memcpy(r, q, d * sizeof(double));
              if (v) std::memcpy(r + d, v, d * sizeof(double));
              r[2 * d] = t;
          }) {}
};

void jet(const void* p, const double& t, const double* q, const double* v, double* value, double* gradient,
         double* hessian) {
    const Model& m = self(p);
    const Registers r(m, m.jet, t, q, v);
    const auto n = static_cast<std::size_t>(2 * m.d);
    *value = r[0];
    r.copy(1, n, gradient);
    if (m.hessian.empty()) {
        std::fill_n(hessian, n * n, 0.0);
        for (const Model::Constant& c : m.constants) hessian[c.at] = hessian[c.mirrored] = c.value;
    } else {
        std::memcpy(hessian, m.hessian.data(), n * n * sizeof(double));
    }
    for (const Model::Place& place : m.places) hessian[place.at] = hessian[place.mirrored] = r[place.output];
}

void gradient(const void* p, const double& t, const double* q, const double* v, double* g) {
    const Model& m = self(p);
    const Registers r(m, m.gradient, t, q, v);
    r.copy(0, static_cast<std::size_t>(2 * m.d), g);
}

/// L_q; of a sum it does not depend on v.
void force(const Model& m, double t, const double* q, const double* v, double* f) {
    const Registers r(m, m.force, t, q, v);
    r.copy(0, static_cast<std::size_t>(m.d), f);
}
void forceAlone(const void* p, const double& t, const double* q, double* f) {
    force(self(p), t, q, nullptr, f);
}
void separableKicks(const void* model, const KicksAndDrifts<double>& by, double* q, double* p, double* f) {
    self(model).kicks.take(by, q, p, f);
}

/// Eight nodes at a time, in the instruction set of this machine: outputs of a tape at q, v and t, output k
/// of node i to where `place(k)` begins, plus i.
class NodeTapes {
public:
    using Forces = void (*)(const void*, const double* t, int nodes, const double* q, double* f);
    using Calls = void (*)(const void*, const double* t, int nodes, const double* q, const double* v,
                           double* to);
    static Forces forces() { return ForThisMachine<&forceLanes>::call(); }
    static Calls gradients() { return ForThisMachine<&gradientLanes>::call(); }
    static Calls hessians() { return ForThisMachine<&hessianLanes>::call(); }

private:
    /// `write(k, value)`: of the nodes from i on.
    template <class Write>
    static void eight(const Model& m, const Tape& tape, const double* t, int nodes, const double* q,
                      const double* v, int i, const Write& write) {
        runEight(
            tape,
            [&](Lanes* r) {
                for (int k = 0; k < m.d; ++k) {
                    r[k] = Lanes::load(q + k * nodes + i);
                    if (v) r[m.d + k] = Lanes::load(v + k * nodes + i);
                }
                r[2 * m.d] = Lanes::load(t + i);
            },
            write);
    }
    static void gradientsOf(const Model& m, const Tape& tape, const double* t, int nodes, const double* q,
                            const double* v, double* to) {
        for (int i = 0; i < nodes; i += 8)
            eight(m, tape, t, nodes, q, v, i, [&](std::size_t k, const Lanes& value) {
                storeEight(value, to + static_cast<int>(k) * nodes + i);
            });
    }
    /// Separable: L_q does not depend on v.
    static void forceLanes(const void* p, const double* t, int nodes, const double* q, double* f) {
        gradientsOf(self(p), self(p).force, t, nodes, q, nullptr, f);
    }
    static void gradientLanes(const void* p, const double* t, int nodes, const double* q, const double* v,
                              double* g) {
        gradientsOf(self(p), self(p).gradient, t, nodes, q, v, g);
    }
    static void hessianLanes(const void* p, const double* t, int nodes, const double* q, const double* v,
                             double* h) {
        const Model& m = self(p);
        for (std::size_t entry = 0; entry < m.hessian.size(); ++entry)
            std::fill_n(h + static_cast<int>(entry) * nodes, nodes, m.hessian[entry]);
        for (int i = 0; i < nodes; i += 8)
            eight(m, m.hessians, t, nodes, q, v, i, [&](std::size_t k, const Lanes& value) {
                const Model::Place& place = m.places[k];
                storeEight(value, h + static_cast<int>(place.at) * nodes + i);
                storeEight(value, h + static_cast<int>(place.mirrored) * nodes + i);
            });
    }
};

bool separableVelocity(const void* p, const double&, const double*, const double* momentum, double* v) {
    const Model& m = self(p);
    for (std::size_t i = 0; i < static_cast<std::size_t>(m.d); ++i) v[i] = momentum[i] / m.masses[i];
    return true;
}

/// Solves M x = b in place, M as a lower triangle; of few coordinates, so nothing is allocated.
bool solveMass(int d, const double* triangle, double* x) {
    if (d > static_cast<int>(fewCoordinates)) {
        Eigen::MatrixXd mass(d, d);
        for (int i = 0; i < d; ++i)
            for (int j = 0; j <= i; ++j) mass(i, j) = mass(j, i) = *triangle++;
        Eigen::Map<Eigen::VectorXd> b(x, d);
        b = dense::solve<double>(mass, b);
        return b.allFinite();
    }
    double mass[fewCoordinates * fewCoordinates];
    for (int i = 0; i < d; ++i)
        for (int j = 0; j <= i; ++j) mass[i * d + j] = mass[j * d + i] = *triangle++;
    eliminate(d, mass, x);
    return std::all_of(x, x + d, [](double each) { return std::isfinite(each); });
}

/// v from r = p - L_v at a guess, by one solve with the mass matrix there. Outputs of the tape: L_v, then
/// L_vv, or its diagonal where there is no other entry.
bool solveVelocity(const Model& m, const Registers& r, double* x) {
    const auto d = static_cast<std::size_t>(m.d);
    if (m.isDiagonal) {
        bool isFinite = true;
        for (std::size_t i = 0; i < d; ++i) {
            x[i] /= r[d + i];
            isFinite = isFinite && std::isfinite(x[i]);
        }
        return isFinite;
    }
    double few[fewCoordinates * (fewCoordinates + 1) / 2];
    std::vector<double> many(d > fewCoordinates ? d * (d + 1) / 2 : 0);
    double* const triangle = d > fewCoordinates ? many.data() : few;
    for (std::size_t k = 0; k < d * (d + 1) / 2; ++k) triangle[k] = r[d + k];
    return solveMass(m.d, triangle, x);
}

bool quadraticVelocity(const void* p, const double& t, const double* q, const double* momentum, double* v) {
    const Model& m = self(p);
    const Registers r(m, m.legendre, t, q, q);  // at v = 0, put in place
    for (std::size_t i = 0; i < static_cast<std::size_t>(m.d); ++i) v[i] = momentum[i] - r[i];
    return solveVelocity(m, r, v);
}

/// Newton on L_v(t, q, v) = p from the velocity in v, to round-off.
bool newtonVelocityFrom(const Model& m, double t, const double* q, const double* momentum, double* v) {
    const auto d = static_cast<std::size_t>(m.d);
    double change[maxCoordinates], step[maxCoordinates] = {}, last = -1;
    for (int iteration = 0; iteration < 100; ++iteration) {
        const Registers r(m, m.legendre, t, q, v);
        for (std::size_t i = 0; i < d; ++i) change[i] = momentum[i] - r[i];
        // The root itself, where the mass matrix may be singular: v^4 at rest.
        if (std::all_of(change, change + d, [](double x) { return x == 0; })) return true;
        // Out of the domain of L, such as beyond the speed of light: half as far.
        if (!std::all_of(change, change + d, [](double x) { return std::isfinite(x); })) {
            for (std::size_t i = 0; i < d; ++i) v[i] -= step[i] /= 2;
            continue;
        }
        if (!solveVelocity(m, r, change)) return false;
        std::copy_n(change, d, step);
        double size = 0, scale = 0;
        for (std::size_t i = 0; i < d; ++i) {
            v[i] += change[i];
            size += std::fabs(change[i]);
            scale += std::fabs(v[i]);
        }
        if (!(size < 1e300)) return false;
        if (size <= 1e-15 * scale) return true;
        if (iteration > 5 && size >= last && size <= 1e-10 * scale) return true;
        last = size;
    }
    return false;
}

/// Newton from v = 0, and where L has no curvature or no meaning at rest (v^4, |v|^3, v log v) from
/// velocities of several sizes, in the directions of the momenta and, where these do not help, all positive.
bool newtonVelocity(const void* p, const double& t, const double* q, const double* momentum, double* v) {
    const Model& m = self(p);
    const auto d = static_cast<std::size_t>(m.d);
    std::fill_n(v, d, 0);
    if (newtonVelocityFrom(m, t, q, momentum, v)) return true;
    constexpr double speeds[] = {1, 0.1, 10, 1e-2, 100, 1e-4, 1e4};
    for (const bool isAlongMomenta : {true, false})
        for (const double speed : speeds) {
            for (std::size_t i = 0; i < d; ++i)
                v[i] = isAlongMomenta ? std::copysign(speed, momentum[i]) : speed;
            if (newtonVelocityFrom(m, t, q, momentum, v)) return true;
        }
    return false;
}

double energy(const void* p, const double& t, const double* q, const double* momentum, bool isFound,
              const double* v) {
    const Model& m = self(p);
    if (!isFound) return std::numeric_limits<double>::quiet_NaN();
    const Registers r(m, m.value, t, q, v);
    double sum = -r[0];
    for (std::size_t i = 0; i < static_cast<std::size_t>(m.d); ++i) sum += momentum[i] * v[i];
    return sum;
}

/// Energy and flow are the same over each of the three Legendre transforms.
template <bool (*velocity)(const void*, const double&, const double*, const double*, double*)>
struct Over {
    static double energyOf(const void* p, const double& t, const double* q, const double* momentum) {
        double v[maxCoordinates];
        const bool isFound = velocity(p, t, q, momentum, v);
        return energy(p, t, q, momentum, isFound, v);
    }
    static bool flow(const void* p, const double& t, const double* q, const double* momentum, double* qdot,
                     double* pdot) {
        if (!velocity(p, t, q, momentum, qdot)) return false;
        force(self(p), t, q, qdot, pdot);
        return true;
    }
    static void set(Mechanics<double>& m) {
        m.velocity = velocity;
        m.energy = energyOf;
        m.flow = flow;
    }
};

/// The nodes of the derivatives with the parameters' values in place.
struct Numeric {
    Graph graph;
    int value;
    std::vector<int> gradient, hessian;

    Numeric(const SymbolicLagrangian& from, const Formula& formula) {
        std::vector<int> roots{from.value};
        roots.insert(roots.end(), from.gradient.begin(), from.gradient.end());
        roots.insert(roots.end(), from.hessian.begin(), from.hessian.end());
        const std::vector<int> here =
            graph.adopt(from.graph, roots, [&](int symbol) -> std::optional<double> {
                const int k = symbol - formula.firstParameter();
                if (k < 0) return {};
                return formula.parameters[static_cast<std::size_t>(k)].second;
            });
        const auto first = here.begin() + 1,
                   second = first + static_cast<std::ptrdiff_t>(from.gradient.size());
        value = here.front();
        gradient.assign(first, second);
        hessian.assign(second, here.end());
    }
    int second(int i, int j) const { return hessian[static_cast<std::size_t>(i * (i + 1) / 2 + j)]; }
};

class Builder {
public:
    Builder(const Formula& formula, Numeric& n) : formula_(formula), n_(n), d_(formula.dimension()) {}

    TypedMechanics build() {
        model_->d = d_;
        model_->value = tape({n_.value});
        model_->gradient = tape(n_.gradient);
        model_->force = tape({n_.gradient.begin(), n_.gradient.begin() + d_});
        buildJet();
        buildLegendre();
        model_->landmarks = Landmarks(n_.graph, n_.value, 2 * d_ + 1);
        model_->branches = Branches::of(formula_);
        TypedMechanics made;
        Mechanics<double>& m = made.mechanics;
        m.dimension = d_;
        m.jet = jet;
        m.gradient = gradient;
        if (d_ <= static_cast<int>(fewCoordinates)) {
            m.gradients = NodeTapes::gradients();
            m.hessians = NodeTapes::hessians();
        }
        m.isTimeDependent = n_.graph.dependsOn({n_.value}, [&](int s) { return s == formula_.time(); });
        if (findMasses()) {
            m.isSeparable = true;
            if (!m.isTimeDependent) addKicks(m);
            m.forces = NodeTapes::forces();
            m.masses = model_->masses.data();
            Over<separableVelocity>::set(m);
        } else {
            (model_->isQuadratic ? Over<quadraticVelocity>::set : Over<newtonVelocity>::set)(m);
        }
        if (isSum()) m.force = forceAlone;
        for (int i = 0; i < d_; ++i)
            if (n_.graph.isZero(n_.gradient[static_cast<std::size_t>(i)])) made.cyclic.push_back(i);
        m.model = std::move(model_);
        return made;
    }

private:
    Tape tape(const std::vector<int>& roots) const { return Tape::of(n_.graph, roots, 2 * d_ + 1); }
    bool isVelocity(int symbol) const { return symbol >= d_ && symbol < 2 * d_; }

    /// Whether L = T(t, v) - V(t, q), which makes H a sum as well.
    bool isSum() const {
        const auto middle = n_.gradient.begin() + d_;
        return !n_.graph.dependsOn({n_.gradient.begin(), middle}, [this](int s) { return isVelocity(s); }) &&
               !n_.graph.dependsOn({middle, n_.gradient.end()}, [this](int s) { return s < d_; });
    }

    void buildJet() {
        const auto n = static_cast<std::size_t>(2 * d_);
        std::vector<int> roots{n_.value};
        roots.insert(roots.end(), n_.gradient.begin(), n_.gradient.end());
        const bool isSmall = d_ <= static_cast<int>(fewCoordinates);
        if (isSmall) model_->hessian.assign(n * n, 0);
        for (std::size_t i = 0, k = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j, ++k) {
                const int node = n_.hessian[k];
                if (n_.graph.isNumber(node)) {
                    const double value = n_.graph.at(node).number;
                    if (isSmall) model_->hessian[i * n + j] = model_->hessian[j * n + i] = value;
                    if (value != 0) model_->constants.push_back({i * n + j, j * n + i, value});
                } else {
                    model_->places.push_back({roots.size(), i * n + j, j * n + i});
                    roots.push_back(node);
                }
            }
        model_->jet = tape(roots);
        roots.erase(roots.begin(), roots.begin() + 1 + static_cast<std::ptrdiff_t>(n));
        model_->hessians = tape(roots);
    }
    std::vector<int> massNodes() const {
        std::vector<int> nodes;
        for (int i = 0; i < d_; ++i)
            for (int j = model_->isDiagonal ? i : 0; j <= i; ++j) nodes.push_back(n_.second(d_ + i, d_ + j));
        return nodes;
    }
    void buildLegendre() {
        model_->isDiagonal = true;
        for (int i = 0; i < d_; ++i)
            for (int j = 0; j < i; ++j)
                model_->isDiagonal = model_->isDiagonal && n_.graph.isZero(n_.second(d_ + i, d_ + j));
        const std::vector<int> mass = massNodes();
        const auto atZero = [&](int symbol) {
            return isVelocity(symbol) ? std::optional<double>(0) : std::nullopt;
        };
        std::vector<int> roots(n_.gradient.begin() + d_, n_.gradient.end());
        model_->isQuadratic = !n_.graph.dependsOn(mass, [&](int s) { return isVelocity(s); });
        roots.insert(roots.end(), mass.begin(), mass.end());
        if (model_->isQuadratic) {
            Graph graph;
            const std::vector<int> there = graph.adopt(n_.graph, roots, atZero);
            model_->legendre = Tape::of(graph, there, 2 * d_ + 1);
        } else {
            model_->legendre = tape(roots);
        }
    }
    /// L_v = (m_i v_i) with constant m_i, seen in the formulas themselves.
    bool findMasses() {
        if (!model_->isDiagonal) return false;
        // Derivatives of steps are 0: round(x_t)*x has a force with velocities in it, and no momentum.
        const std::vector<int> forces(n_.gradient.begin(), n_.gradient.begin() + d_);
        if (n_.graph.dependsOn(forces, [&](int s) { return isVelocity(s); })) return false;
        std::vector<double> masses;
        for (int i = 0; i < d_; ++i) {
            const int mass = n_.second(d_ + i, d_ + i);
            if (!n_.graph.isNumber(mass) || n_.graph.isZero(mass)) return false;
            masses.push_back(n_.graph.at(mass).number);
            const int momentum = n_.graph.scaled(n_.graph.symbol(d_ + i), masses.back());
            if (n_.gradient[static_cast<std::size_t>(d_ + i)] != momentum) return false;
        }
        model_->masses = std::move(masses);
        return true;
    }

    void addKicks(Mechanics<double>& m) {
        const auto forces = std::span(n_.gradient).first(model_->masses.size());
        model_->kicks = KickTape::ofSeparable(n_.graph, forces, model_->masses);
        m.kicksAndDrifts = separableKicks;
    }

    const Formula& formula_;
    Numeric& n_;
    int d_;
    std::shared_ptr<Model> model_ = std::make_shared<Model>();
};

/// The entries of the Hessian that are not always 0: constants, then those of `places`.
struct EntriesModel {
    std::shared_ptr<const void> mechanics;
    std::vector<double> constants;
};
void jetEntries(const void* p, double t, const double* q, const double* v, double* gradient,
                double* hessian) {
    const auto& entries = *static_cast<const EntriesModel*>(p);
    const Model& m = self(entries.mechanics.get());
    const Registers r(m, m.jet, t, q, v);
    const auto n = static_cast<std::size_t>(2 * m.d);
    r.copy(1, n, gradient);
    hessian = std::copy(entries.constants.begin(), entries.constants.end(), hessian);
    r.copy(1 + n, m.places.size(), hessian);  // their outputs follow those of the gradient
}

}  // namespace

LagrangianEntries entriesOf(const Mechanics<double>& mechanics) {
    const Model& m = self(mechanics.model.get());
    const auto n = static_cast<std::size_t>(2 * m.d);
    auto model = std::make_shared<EntriesModel>();
    model->mechanics = mechanics.model;
    LagrangianEntries made;
    for (const Model::Constant& c : m.constants) {
        made.hessian.push_back({static_cast<int>(c.at / n), static_cast<int>(c.at % n)});
        model->constants.push_back(c.value);
    }
    for (const Model::Place& place : m.places)
        made.hessian.push_back({static_cast<int>(place.at / n), static_cast<int>(place.at % n)});
    made.model = std::move(model);
    made.jet = jetEntries;
    return made;
}

const Landmarks* landmarksOf(const Mechanics<double>& mechanics) {
    return mechanics.jet == jet ? &self(mechanics.model.get()).landmarks : nullptr;
}
const Tape* gradientTapeOf(const Mechanics<double>& mechanics) {
    return mechanics.jet == jet ? &self(mechanics.model.get()).gradient : nullptr;
}
const Tape* jetTapeOf(const Mechanics<double>& mechanics) {
    return mechanics.jet == jet ? &self(mechanics.model.get()).jet : nullptr;
}
std::shared_ptr<const Branches> branchesOf(const Mechanics<double>& mechanics) {
    return mechanics.jet == jet ? self(mechanics.model.get()).branches : nullptr;
}

TypedMechanics makeMechanics(const Formula& formula) {
    const auto symbolic = differentiate(formula);
    Numeric numeric(*symbolic, formula);
    return Builder(formula, numeric).build();
}

}  // namespace extremal::typed
