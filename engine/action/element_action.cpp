#include "engine/action/element_action.hpp"

#include <boost/multiprecision/float128.hpp>

#include <Eigen/Core>

#include <utility>

namespace extremal {

template <class T>
ElementAction<T>::ElementAction(Mechanics<T> mechanics, Table<T> table)
    : mechanics_(std::move(mechanics)), table_(std::move(table)) {}

template <class T>
bool ElementAction<T>::evaluate(const T& t0, const T& h, const Matrix& Z, T& S, Vector* gradient,
                                Matrix* hessian) const {
    const int d = dimension(), m = functions();
    Vector value(m), slope(m), q(d), v(d), g(2 * d);
    Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> H(2 * d, 2 * d);
    S = T(0);
    if (gradient) *gradient = Vector::Zero(m * d);
    if (hessian) *hessian = Matrix::Zero(m * d, m * d);
    for (int i = 0; i < table_.nodes(); ++i) {
        value << table_.testValue(i, m - 2), table_.value.row(i).transpose();
        slope << table_.testDerivative(i, m - 2), table_.derivative.row(i).transpose();
        q = Z * value;
        v = Z * slope / h;
        T L;
        mechanics_.jet(mechanics_.model.get(), t0 + table_.node(i) * h, q.data(), v.data(), &L, g.data(),
                       H.data());
        const T b = table_.weight(i);
        S += b * h * L;
        if (gradient)
            for (int a = 0; a < m; ++a)
                gradient->segment(a * d, d) += b * (h * value(a) * g.head(d) + slope(a) * g.tail(d));
        if (!hessian) continue;
        for (int a = 0; a < m; ++a)
            for (int c = 0; c < m; ++c)
                hessian->block(a * d, c * d, d, d) +=
                    b * (h * value(a) * value(c) * H.topLeftCorner(d, d) +
                         value(a) * slope(c) * H.topRightCorner(d, d) +
                         slope(a) * value(c) * H.bottomLeftCorner(d, d) +
                         slope(a) * slope(c) / h * H.bottomRightCorner(d, d));
    }
    using std::isfinite;
    const T size = gradient ? T(gradient->sum() + S) : S;
    return isfinite(static_cast<double>(size));
}

template class ElementAction<double>;
template class ElementAction<boost::multiprecision::float128>;

}  // namespace extremal
