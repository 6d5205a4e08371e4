// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/phase/typed_hamiltonian.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/tape/node_tape.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/tape/tape.hpp"
#include "engine/model/typed/tape/tape_kicks.hpp"
#include "engine/model/typed/tape/tape_registers.hpp"
#include "engine/model/typed/typed_model.hpp"

namespace extremal::typed {
namespace {

/// Everything the calls need; immutable once made.
struct PhaseModel {
    std::size_t d = 0;
    Tape value, gradient, hessian;
    Tape velocity, force;  ///< H_p and -H_q of a sum A(t, p) + B(t, q)
    KickTape kicks;        ///< of a sum that does not know the time
    struct Place {
        std::size_t output, at, mirrored;  ///< output of the tape -> two entries of the Hessian
    };
    std::vector<Place> places;
    std::vector<double> constants;  ///< the Hessian with its constant entries in place
};

const PhaseModel& modelOf(const void* p) { return *static_cast<const PhaseModel*>(p); }

/// One evaluation of a tape at (t, q, p). The rates of q and p are inputs as well, which H has not got.
class PhaseRegisters : public TapeRegisters {
public:
    PhaseRegisters(const PhaseModel& m, const Tape& tape, double t, const double* q, const double* p)
        : TapeRegisters(tape, [&](double* r) {
              std::copy_n(q, m.d, r);
              std::copy_n(p, m.d, r + m.d);
              r[4 * m.d] = t;
          }) {}
};

double energyAt(const void* model, double t, const double* q, const double* p) {
    const PhaseModel& m = modelOf(model);
    return PhaseRegisters(m, m.value, t, q, p)[0];
}
void gradientAt(const void* model, double t, const double* q, const double* p, double* gradient) {
    const PhaseModel& m = modelOf(model);
    const PhaseRegisters r(m, m.gradient, t, q, p);
    for (std::size_t i = 0; i < 2 * m.d; ++i) gradient[i] = r[i];
}
void velocityAt(const void* model, double t, const double* p, double* v) {
    const PhaseModel& m = modelOf(model);
    PhaseRegisters(m, m.velocity, t, p, p).copy(0, m.d, v);
}
void forceAt(const void* model, double t, const double* q, double* f) {
    const PhaseModel& m = modelOf(model);
    PhaseRegisters(m, m.force, t, q, q).copy(0, m.d, f);
}
void kicksAndDriftsOf(const void* model, const KicksAndDrifts<double>& steps, double* q, double* p,
                      double* force) {
    modelOf(model).kicks.take(steps, q, p, force);
}
void hessianAt(const void* model, double t, const double* q, const double* p, double* hessian) {
    const PhaseModel& m = modelOf(model);
    const PhaseRegisters r(m, m.hessian, t, q, p);
    std::copy(m.constants.begin(), m.constants.end(), hessian);
    for (const PhaseModel::Place& place : m.places)
        hessian[place.at] = hessian[place.mirrored] = r[place.output];
}

/// Eight nodes at a time.
void outputLanes(const PhaseModel& m, const Tape& tape, const double* t, int nodes, const double* q,
                 const double* p, double* outputs) {
    for (int i = 0; i < nodes; i += 8)
        runEight(
            tape,
            [&](Lanes* r) {
                for (std::size_t k = 0; k < m.d; ++k) {
                    r[k] = Lanes::load(q + static_cast<int>(k) * nodes + i);
                    r[m.d + k] = Lanes::load(p + static_cast<int>(k) * nodes + i);
                }
                r[4 * m.d] = Lanes::load(t + i);
            },
            [&](std::size_t k, const Lanes& value) {
                storeEight(value, outputs + static_cast<int>(k) * nodes + i);
            });
}
void gradientLanes(const void* model, const double* t, int nodes, const double* q, const double* p,
                   double* gradients) {
    outputLanes(modelOf(model), modelOf(model).gradient, t, nodes, q, p, gradients);
}

void forceLanes(const void* model, const double* t, int nodes, const double* q, double* f) {
    const PhaseModel& m = modelOf(model);
    for (int i = 0; i < nodes; i += 8)
        runEight(
            m.force,
            [&](Lanes* r) {
                for (std::size_t k = 0; k < m.d; ++k) r[k] = Lanes::load(q + static_cast<int>(k) * nodes + i);
                r[4 * m.d] = Lanes::load(t + i);
            },
            [&](std::size_t k, const Lanes& value) {
                storeEight(value, f + static_cast<int>(k) * nodes + i);
            });
}

/// Velocities have no meaning in H.
void refuseVelocities(const Formula& formula) {
    const ResolvedFormula resolved = resolve(formula);
    const int n = formula.dimension();
    for (std::size_t k = 0; k < resolved.symbol.size(); ++k) {
        const int symbol = resolved.symbol[k];
        if (symbol < n || symbol >= 2 * n) continue;
        const std::string& name = formula.coordinates[static_cast<std::size_t>(symbol - n)];
        throw ExpressionError("has the velocity " + name + "_t", resolved.expression.nodes[k].position,
                              symbol - n < n / 2
                                  ? "a Hamiltonian is a function of " + name + " and its momentum p_" + name
                                  : "a Hamiltonian is a function of coordinates, momenta and t");
    }
}

/// The derivatives with the parameters' values in place.
class HamiltonianBuilder {
public:
    HamiltonianBuilder(const SymbolicLagrangian& from, const Formula& formula)
        : formula_(formula), n_(formula.dimension()), d_(n_ / 2) {
        std::vector<int> roots{from.value};
        roots.insert(roots.end(), from.gradient.begin(), from.gradient.begin() + n_);
        roots.insert(roots.end(), from.hessian.begin(), from.hessian.begin() + n_ * (n_ + 1) / 2);
        const std::vector<int> here =
            graph_.adopt(from.graph, roots, [&](int symbol) -> std::optional<double> {
                const int k = symbol - formula.firstParameter();
                if (k < 0) return {};
                return formula.parameters[static_cast<std::size_t>(k)].second;
            });
        value_ = here.front();
        gradient_.assign(here.begin() + 1, here.begin() + 1 + n_);
        hessian_.assign(here.begin() + 1 + n_, here.end());
    }

    TypedHamiltonian build() {
        TypedHamiltonian made;
        PhaseMechanics& m = made.mechanics;
        const auto model = std::make_shared<PhaseModel>();
        model->d = static_cast<std::size_t>(d_);
        model->value = tape({value_});
        model->gradient = tape(gradient_);
        placeHessian(*model);
        m.dimension = d_;
        m.energy = energyAt;
        m.gradient = gradientAt;
        m.hessian = hessianAt;
        constexpr int few = 16;  // more of them fill the registers of one node alone
        if (d_ <= few) m.gradients = ForThisMachine<&gradientLanes>::call();
        m.isTimeDependent = graph_.dependsOn({value_}, [&](int s) { return s == formula_.time(); });
        m.inverseMasses = inverseMasses();
        if (isSum()) {
            std::vector<int> forces;
            for (int i = 0; i < d_; ++i)
                forces.push_back(graph_.scaled(gradient_[static_cast<std::size_t>(i)], -1));
            model->force = tape(forces);
            model->velocity = tape({gradient_.begin() + d_, gradient_.end()});
            m.force = forceAt;
            m.velocity = velocityAt;
            if (m.isSeparable()) m.forces = ForThisMachine<&forceLanes>::call();
            if (!m.isTimeDependent) addKicks(m, *model, forces);
        }
        m.model = model;
        for (int i = 0; i < d_; ++i)
            if (graph_.isZero(gradient_[static_cast<std::size_t>(i)])) made.cyclic.push_back(i);
        return made;
    }

private:
    void addKicks(PhaseMechanics& m, PhaseModel& model, const std::vector<int>& forces) const {
        m.kicksAndDrifts = kicksAndDriftsOf;
        if (!m.isSeparable()) {
            model.kicks = KickTape::ofSum(graph_, forces, std::span(gradient_).subspan(model.d));
            return;
        }
        std::vector<double> masses;
        for (const double w : m.inverseMasses) masses.push_back(1 / w);
        model.kicks = KickTape::ofSeparable(graph_, forces, masses);
    }
    Tape tape(const std::vector<int>& roots) const { return Tape::of(graph_, roots, formula_.time() + 1); }
    int second(int i, int j) const { return hessian_[static_cast<std::size_t>(i * (i + 1) / 2 + j)]; }

    void placeHessian(PhaseModel& model) const {
        const auto n = static_cast<std::size_t>(n_);
        model.constants.assign(n * n, 0);
        std::vector<int> roots;
        for (std::size_t i = 0, k = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j, ++k) {
                if (graph_.isNumber(hessian_[k])) {
                    model.constants[i * n + j] = model.constants[j * n + i] = graph_.at(hessian_[k]).number;
                } else {
                    model.places.push_back({roots.size(), i * n + j, j * n + i});
                    roots.push_back(hessian_[k]);
                }
            }
        model.hessian = tape(roots);
    }
    /// Whether H_q has no momenta, and H_p no coordinates.
    bool isSum() const {
        const std::vector<int> ofPlaces(gradient_.begin(), gradient_.begin() + d_),
            ofMomenta(gradient_.begin() + d_, gradient_.end());
        return !graph_.dependsOn(ofPlaces, [this](int s) { return s >= d_ && s < n_; }) &&
               !graph_.dependsOn(ofMomenta, [this](int s) { return s < d_; });
    }
    /// w_i of H_p = (w_i p_i) with constant w_i, seen in the formulas themselves; else empty.
    std::vector<double> inverseMasses() {
        std::vector<double> found;
        for (int i = d_; i < n_; ++i) {
            const int own = second(i, i);
            if (!graph_.isNumber(own) || graph_.isZero(own)) return {};
            found.push_back(graph_.at(own).number);
            // Equal formulas are one node.
            const int linear = graph_.scaled(graph_.symbol(i), found.back());
            if (gradient_[static_cast<std::size_t>(i)] != linear) return {};
        }
        return found;
    }

    const Formula& formula_;
    int n_, d_;
    Graph graph_;
    int value_ = 0;
    std::vector<int> gradient_, hessian_;
};

/// With the keys of a typed Lagrangian of twice as many coordinates, whose reader knows names, terms, indices
/// and controls.
Settings asLagrangian(const Settings& settings) {
    Settings made = settings;
    for (auto& [key, value] : made.keys) {
        if (key == "hamiltonian") key = "lagrangian";
        if (key != "coordinates") continue;
        Value::Array names = value.asArray();
        const std::size_t d = names.size();
        for (std::size_t i = 0; i < d; ++i) names.emplace_back("p_" + names[i].asString());
        value = Value(std::move(names));
    }
    return made;
}

/// The pointers of a Lagrangian's keys to those of the Hamiltonian.
[[noreturn]] void rethrow(const InvalidScene& e, std::size_t coordinates) {
    std::vector<Problem> problems = e.problems();
    for (Problem& p : problems) {
        if (p.pointer.starts_with("/lagrangian")) p.pointer = "/hamiltonian" + p.pointer.substr(11);
        for (std::size_t i = 0; i < coordinates; ++i)
            if (p.pointer == "/coordinates/" + std::to_string(coordinates + i))
                p.pointer = "/coordinates/" + std::to_string(i);
    }
    throw InvalidScene(std::move(problems));
}

}  // namespace

Formula phaseFormulaOf(const Settings& settings) {
    const Value* const names = settings.find("coordinates");
    try {
        return formulaOf(asLagrangian(settings));
    } catch (const InvalidScene& e) {
        rethrow(e, names && names->isArray() ? names->asArray().size() : 0);
    }
}

Formula coordinatesOf(const Formula& phaseFormula) {
    Formula half = phaseFormula;
    half.coordinates.resize(phaseFormula.coordinates.size() / 2);
    return half;
}

TypedHamiltonian hamiltonianOf(const Formula& formula) {
    try {
        refuseVelocities(formula);
        const auto symbolic = differentiate(formula);
        return HamiltonianBuilder(*symbolic, formula).build();
    } catch (const ExpressionError& e) {
        throw InvalidScene("/hamiltonian",
                           std::string(e.what()) + "\n" + caretLines(formula.text, e.position), e.hint);
    }
}

std::optional<std::string> hamiltonianFaultAt(const PhaseMechanics& m, double t, const double* q,
                                              const double* p) {
    const auto n = static_cast<std::size_t>(2 * m.dimension);
    std::vector<double> values(n * n + n + 1);
    values[0] = m.energy(m.model.get(), t, q, p);
    m.gradient(m.model.get(), t, q, p, values.data() + 1);
    m.hessian(m.model.get(), t, q, p, values.data() + 1 + n);
    if (std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) return {};
    return "is not finite, or has no finite derivatives, at the initial data";
}

}  // namespace extremal::typed
