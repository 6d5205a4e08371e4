// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/first_order/first_order.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/own_buffers.hpp"
#include "engine/model/first_order/joined_state.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/model/first_order/poisson.hpp"
#include "engine/model/system.hpp"

namespace extremal {
namespace {

struct FirstOrderModel {
    FirstOrder of;
    long long id;
};
const FirstOrderModel& modelAt(const void* p) { return *static_cast<const FirstOrderModel*>(p); }

struct OwnEquations : JoinedState {
    explicit OwnEquations(const FirstOrder& of)
        : JoinedState(static_cast<std::size_t>(of.variables)), equations(of.make()) {}
    std::unique_ptr<FirstOrderEquations> equations;
};
OwnEquations& ownEquations(const void* model) {
    return ownBuffers<OwnEquations>(modelAt(model).id, modelAt(model).of);
}

bool firstOrderFlow(const void* model, const double&, const double* q, const double* p, double* qdot,
                    double* pdot) {
    OwnEquations& own = ownEquations(model);
    if (!own.equations->rate(own.join(q, p), own.dx.data())) return false;
    own.splitRate(qdot, pdot);
    return true;
}
double firstOrderEnergy(const void* model, const double&, const double* q, const double* p) {
    return modelAt(model).of.energy(ownEquations(model).join(q, p), nullptr);
}

double withoutEnergy(const void*, double, const double*, const double*) { return 0; }
void fieldGradient(const void* model, double, const double* q, const double*, double* gradient) {
    const int m = modelAt(model).of.variables;
    std::fill_n(gradient, m, 0.0);
    if (!ownEquations(model).equations->rate(q, gradient + m))
        std::fill_n(gradient + m, m, std::numeric_limits<double>::quiet_NaN());
}
void fieldHessian(const void* model, double, const double* q, const double*, double* hessian) {
    const int m = modelAt(model).of.variables;
    Eigen::Map<Eigen::MatrixXd> H(hessian, 2 * m, 2 * m);
    H.setZero();
    const Eigen::MatrixXd* const slope = ownEquations(model).equations->jacobian(q);
    if (slope)
        H.bottomLeftCorner(m, m) = *slope;
    else
        H.bottomLeftCorner(m, m).setConstant(std::numeric_limits<double>::quiet_NaN());
    H.topRightCorner(m, m) = H.bottomLeftCorner(m, m).transpose();
}

}  // namespace

bool isFirstOrder(const System& system) {
    return system.parts.find<OneForm>() || system.parts.find<PoissonStructure>();
}

FirstOrder firstOrderOf(const System& system) {
    if (const OneForm* const form = system.parts.find<OneForm>()) return firstOrderOf(*form);
    if (const PoissonStructure* const bracket = system.parts.find<PoissonStructure>())
        return firstOrderOf(*bracket);
    return {};
}

Takes firstOrderProblems() { return flowProblems().with<OneForm, PoissonStructure>(); }

Mechanics<double> flowOf(const FirstOrder& of) {
    Mechanics<double> made;
    made.dimension = of.variables / 2;
    made.model = std::make_shared<const FirstOrderModel>(FirstOrderModel{of, nextModelId()});
    made.energy = firstOrderEnergy;
    made.flow = firstOrderFlow;
    return made;
}

const FirstOrder* firstOrderOf(const Mechanics<double>& mechanics) {
    return mechanics.flow == firstOrderFlow ? &modelAt(mechanics.model.get()).of : nullptr;
}

PhaseMechanics fieldOf(const FirstOrder& of) {
    PhaseMechanics made;
    made.dimension = of.variables;
    made.model = std::make_shared<const FirstOrderModel>(FirstOrderModel{of, nextModelId()});
    made.energy = withoutEnergy;
    made.gradient = fieldGradient;
    made.hessian = fieldHessian;
    return made;
}

double fastestOf(const FirstOrder& of, const double* x) {
    const std::unique_ptr<FirstOrderEquations> equations = of.make();
    const Eigen::MatrixXd* const slope = equations->jacobian(x);
    return slope && slope->allFinite() ? dense::eigenvalues(*slope).imag().cwiseAbs().maxCoeff() : 0.0;
}

}  // namespace extremal
