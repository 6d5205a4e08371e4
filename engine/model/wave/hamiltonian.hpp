// SPDX-License-Identifier: GPL-3.0-or-later
/// The Schroedinger operator i hbar c' = H c, in one of three forms (WaveBasis):
///     fourier      a periodic interval or rectangle on a Fourier grid (wave/fourier_basis.hpp), in two parts
///                  (wave/split_operator.hpp). Hermitian at any N, the coefficient at k = -N/2 included (the
///                  printed Nyquist rows of Leok 2004, sec. 8.2, are not). hbar^2 k^2/2m is the right kinetic
///                  term; the printed one lacks the mass.
///     convolution  a periodic interval with V psi by the exact convolution of their coefficients
///                  (wave/convolution.hpp), made Hermitian by c = W^{1/2} v/sqrt(2 pi), which halves the
///                  square at k = -N/2. It differs from the former by aliasing alone, which vanishes
///                  spectrally with N, and its H is a full matrix.
///     dirichlet    Dirichlet boundaries, psi = 0 at both ends of an interval: polynomials
///     (wave/dirichlet_basis.hpp),
///                  with mass and stiffness from the action; H is a real symmetric matrix in c, and V enters
///                  through its values at the points of the rule.
/// A form is a basis and what H is in it: two parts, or a matrix. What schemes, observables and views need of
/// it is four things: the way between coefficients and nodes, H applied, the coordinates in which H is real,
/// and mean values (wave/spectrum.hpp).
///
/// The state of a run is c, as 2N numbers (re, im in turn): |c|^2 is the norm squared, h sum |psi_j|^2 or u*
/// M u. A Hamiltonian is immutable and shared; work arrays come from the caller and hold N numbers.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <variant>
#include <vector>

#include "engine/model/wave/basis/dirichlet_basis.hpp"
#include "engine/model/wave/basis/fourier_basis.hpp"
#include "engine/model/wave/potential.hpp"
#include "engine/model/wave/potential_harmonics.hpp"

namespace extremal {

enum class WaveBasis { fourier, convolution, dirichlet };

class Hamiltonian {
public:
    /// nx and ny even on a periodic domain; a potential that does not depend on time and an interval but for
    /// WaveBasis::fourier. Throws InvalidScene (pointer /potential) where V is not finite at a node.
    Hamiltonian(const wave::Grid& grid, double hbar, double mass, wave::Potential potential,
                WaveBasis basis = WaveBasis::fourier);

    int size() const { return grid_.size(); }
    const wave::Grid& grid() const { return grid_; }
    int dimension() const { return grid_.dimension(); }
    WaveBasis basis() const { return form_; }
    bool isPeriodic() const { return std::holds_alternative<FourierBasis>(basis_); }
    /// Whether H is a part diagonal in c and a part diagonal at the nodes, each of which moves psi by phases
    /// alone.
    bool isSplit() const { return form_ == WaveBasis::fourier; }
    double hbar() const { return hbar_; }
    double mass() const { return mass_; }
    /// Along x.
    const wave::Domain& domain() const { return grid_.x; }
    /// f(basis), with a FourierBasis or a DirichletBasis.
    template <class F>
    auto inBasis(F&& f) const {
        return std::visit(std::forward<F>(f), basis_);
    }
    /// The nodes along x; with a Dirichlet boundary those inside.
    const std::vector<double>& x() const;
    /// The nodes along y; 0 on an interval.
    const std::vector<double>& y() const;
    bool isTimeDependent() const { return potential_.isTimeDependent(); }
    /// V at the nodes, at t = 0 where it depends on time.
    const std::vector<double>& potential() const { return V_; }
    /// V at the nodes and t.
    void potentialAt(double t, double* V) const;

    /// Values of psi at the nodes from c, and back; not in place.
    void toNodes(const Complex* c, Complex* psi) const;
    void toCoefficients(const Complex* psi, Complex* c) const;
    /// Orthonormal coordinates in which H is a real matrix: the inverse transform of c (psi_j sqrt(h) where H
    /// is split), or c itself with a Dirichlet boundary; and back, which uses v up.
    void toReal(const Complex* c, Complex* v) const;
    void fromReal(Complex* v, Complex* c) const;
    /// H in these coordinates: known where it is not split, made where it is.
    Eigen::MatrixXd realMatrix() const;
    /// out = H c with these values of V, or where H is a matrix with its own.
    void apply(const double* V, const Complex* c, Complex* out, Complex* work) const;
    /// <H>/<1> at t.
    double energy(double t, const Complex* c) const;
    /// Bounds of the spectrum: min V and max V + max kinetic.
    double lowest() const { return lowest_; }
    double highest() const { return highest_; }

    // Of a periodic domain alone.
    const FourierBasis& fourierBasis() const { return std::get<FourierBasis>(basis_); }
    const Fourier& fourier() const { return fourierBasis().fourier(); }
    /// hbar^2 |k|^2/2m by place in c.
    const std::vector<double>& kinetic() const { return fourierBasis().kinetic(); }
    /// Of a periodic interval alone.
    const PotentialHarmonics& potentialSeries() const { return harmonics_; }
    int harmonics() const { return harmonics_.highest; }
    const std::vector<Complex>& potentialHarmonics() const { return harmonics_.coefficients; }
    // With a Dirichlet boundary alone.
    const DirichletBasis& dirichletBasis() const { return std::get<DirichletBasis>(basis_); }
    const Interval& interval() const { return dirichletBasis().interval(); }
    Eigen::MatrixXd resampling(int rows) const { return dirichletBasis().resampling(rows); }

    /// The same operator on another grid of the same domain.
    std::shared_ptr<const Hamiltonian> withModes(int nx, int ny = 1) const;
    /// Whether both have the same matrix.
    bool isSameAs(const Hamiltonian& other) const;

private:
    void onGrid();
    void onInterval();

    wave::Grid grid_;
    double hbar_, mass_;
    wave::Potential potential_;
    WaveBasis form_;
    std::variant<FourierBasis, DirichletBasis> basis_;
    std::vector<double> V_;
    PotentialHarmonics harmonics_;
    Eigen::MatrixXd matrix_;  ///< in the coordinates of toReal(); empty where H is split
    double lowest_ = 0, highest_ = 0;
};

inline const Complex* coefficients(const double* x) { return reinterpret_cast<const Complex*>(x); }
inline Complex* coefficients(double* x) { return reinterpret_cast<Complex*>(x); }

/// A wave function with a Dirichlet boundary for pictures, from its values at the nodes (all real parts, then
/// all imaginary parts): at `rows` equally spaced points and the ends. Nodes crowd at the ends and are far
/// apart in the middle.
struct EvenSamples {
    std::vector<double> x, re, im;
};
EvenSamples evenSamples(const Hamiltonian& h, const double* values, int rows);

/// sum |c_i|^2.
double squaredNorm(const Complex* c, int n);
/// sum conj(a_i) b_i.
Complex innerProduct(const Complex* a, const Complex* b, int n);

}  // namespace extremal
