// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/action/element_kernel.hpp"

#include <boost/multiprecision/float128.hpp>

#include <Eigen/Core>

#include <limits>
#include <utility>

#include "engine/action/chain_rule.hpp"

namespace extremal {

template <class T>
void ElementDerivatives<T>::Node::resize(int d) {
    for (Vector* each : {&q, &v, &qv, &vv}) each->resize(d);
    gradient.resize(2 * d);
    hessian.resize(2 * d, 2 * d);
}

template <class T>
typename ElementKernel<T>::Functions ElementKernel<T>::sample(const Table<T>& table, ElementBasis basis) {
    const int n = table.nodes(), m = table.unknowns();
    Functions f;
    if (basis == ElementBasis::ends) {
        f.value.resize(n, m + 1);
        f.slope.resize(n, m + 1);
        f.value << table.testValue.col(m - 1), table.value;
        f.slope << table.testDerivative.col(m - 1), table.derivative;
        return f;
    }
    if (basis == ElementBasis::increments) {
        f.value.resize(n, m + 1);
        f.slope.resize(n, m + 1);
        f.value << Vector::Ones(n), table.value;
        f.slope << Vector::Zero(n), table.derivative;
        return f;
    }
    f.value.resize(n, table.space.size);
    f.slope.resize(n, table.space.size);
    std::vector<T> value(static_cast<std::size_t>(table.space.size)), slope(value.size());
    for (int i = 0; i < n; ++i) {
        table.space.evaluate(table.node(i), value, slope);
        f.value.row(i) = Eigen::Map<const Vector>(value.data(), table.space.size).transpose();
        f.slope.row(i) = Eigen::Map<const Vector>(slope.data(), table.space.size).transpose();
    }
    return f;
}

template <class T>
ElementKernel<T>::ElementKernel(Mechanics<T> mechanics, const std::vector<Table<T>>& tables,
                                ElementBasis basis)
    : mechanics_(std::move(mechanics)),
      node_(tables.front().node),
      weight_(tables.front().weight),
      hasStepDerivatives_(!mechanics_.isTimeDependent) {
    for (const Table<T>& table : tables) {
        functions_.push_back(sample(table, basis));
        hasStepDerivatives_ = hasStepDerivatives_ && table.frequency == T(0) && !table.dependsOnStep;
    }
    for (int k = 0; k < dimension(); ++k) {
        offset_.push_back(size_);
        size_ += functions(k);
    }
}

template <class T>
bool ElementKernel<T>::evaluate(const T& t0, const T& h, const Vector& z, DerivativeOrder order,
                                ElementDerivatives<T>& result) const {
    const T none = hasStepDerivatives_ ? T(0) : std::numeric_limits<T>::quiet_NaN();
    result.action = T(0);
    if (order != DerivativeOrder::none) {
        result.gradient = Vector::Zero(size_);
        result.byStep = none;
    }
    if (order == DerivativeOrder::second) {
        result.hessian = Matrix::Zero(size_, size_);
        result.gradientByStep = Vector::Constant(size_, none);
        result.byStepTwice = none;
    }
    auto& at = result.node;
    at.resize(dimension());
    for (int i = 0; i < node_.size(); ++i) {
        for (int k = 0; k < dimension(); ++k) {
            at.q(k) = at.v(k) = T(0);
            for (int a = 0; a < functions(k); ++a) {
                at.q(k) += of(k).value(i, a) * z(index(k, a));
                at.v(k) += of(k).slope(i, a) * z(index(k, a));
            }
            at.v(k) /= h;
        }
        mechanics_.jet(mechanics_.model.get(), t0 + node_(i) * h, at.q.data(), at.v.data(), &at.L,
                       at.gradient.data(), at.hessian.data());
        result.action += weight_(i) * h * at.L;
        if (order != DerivativeOrder::none) addFirst(i, h, result);
        if (order == DerivativeOrder::second) addSecond(i, h, result);
    }
    using std::isfinite;
    T size = result.action;
    if (order != DerivativeOrder::none) size += result.gradient.sum();
    if (order == DerivativeOrder::second) size += result.hessian.sum();
    return isfinite(static_cast<double>(size));
}

template <class T>
void ElementKernel<T>::addFirst(int i, const T& h, ElementDerivatives<T>& to) const {
    const auto& at = to.node;
    const int d = dimension();
    const T b = weight_(i);
    for (int k = 0; k < d; ++k)
        addGradient(
            functions(k), [&](int a) { return testFunction(b, h, of(k).value(i, a), of(k).slope(i, a)); },
            at.gradient(k), at.gradient(d + k), [&](int a) -> T& { return to.gradient(index(k, a)); });
    to.byStep += b * (at.L - at.gradient.tail(d).dot(at.v));
}

template <class T>
void ElementKernel<T>::addSecond(int i, const T& h, ElementDerivatives<T>& to) const {
    auto& at = to.node;
    const int d = dimension();
    const T b = weight_(i);
    const auto& H = at.hessian;
    at.qv.noalias() = H.topRightCorner(d, d).lazyProduct(at.v);
    at.vv.noalias() = H.bottomRightCorner(d, d).lazyProduct(at.v);
    for (int k = 0; k < d; ++k) {
        const auto test = [&](int a) { return testFunction(b, h, of(k).value(i, a), of(k).slope(i, a)); };
        for (int l = 0; l < d; ++l)
            addHessian(
                functions(k), functions(l), test,
                [&](int c) {
                    return TrialFunction<T>{of(l).value(i, c), of(l).slope(i, c)};
                },
                H(k, l), H(k, d + l), H(d + k, l), H(d + k, d + l),
                [&](int a, int c) -> T& { return to.hessian(index(k, a), index(l, c)); });
        for (int a = 0; a < functions(k); ++a)
            to.gradientByStep(index(k, a)) +=
                b * (of(k).value(i, a) * (at.gradient(k) - at.qv(k)) - of(k).slope(i, a) * at.vv(k) / h);
    }
    to.byStepTwice += b * at.v.dot(at.vv) / h;
}

template class ElementKernel<double>;
template class ElementKernel<boost::multiprecision::float128>;

}  // namespace extremal
