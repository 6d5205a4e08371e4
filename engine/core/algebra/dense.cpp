// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/algebra/dense_build.hpp"

#include <complex>

template class Eigen::PartialPivLU<Eigen::MatrixXd>;

namespace extremal::dense {

Eigen::VectorXd rankPivots(Given<double> A) {
    return Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(counted<double>(A, static_cast<double>(A.cols())))
        .matrixQR()
        .diagonal()
        .cwiseAbs();
}

Eigen::MatrixXd triangleOf(Given<double> A) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> factors(counted<double>(A, static_cast<double>(A.cols())));
    return factors.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>();
}

template class Lu<double>;
template class Lu<std::complex<double>>;
template Matrix<double> solve<double>(Given<double>, Given<double>);
template Matrix<std::complex<double>> solve<std::complex<double>>(Given<std::complex<double>>,
                                                                  Given<std::complex<double>>);
template Matrix<double> inverse<double>(Given<double>);
template Matrix<std::complex<double>> inverse<std::complex<double>>(Given<std::complex<double>>);
template Matrix<double> leastSquares<double>(Given<double>, Given<double>);
template Matrix<double> product<double>(Given<double>, Given<double>);
template Qr<double> qr<double>(Given<double>);
template Qr<long double> qr<long double>(Given<long double>);

}  // namespace extremal::dense
