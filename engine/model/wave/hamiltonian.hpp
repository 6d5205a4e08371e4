/// The Schroedinger operator i hbar c' = H c. On a periodic domain, an interval or a rectangle, on a Fourier
/// grid, pseudo-spectrally (WaveBasis::fourier),
///     H = diag(hbar^2 |k|^2/2m) + F diag(V(x_j, t)) F^{-1},   F unitary (wave/fourier.hpp),
/// Hermitian at any N, the coefficient at k = -N/2 included (the printed Nyquist rows of the seed are not).
/// hbar^2 k^2/2m is the right kinetic term; the printed one lacks the mass.
///
/// WaveBasis::convolution is the seed's own: V psi by the exact convolution of their coefficients
/// (wave/convolution.hpp), on an interval; made Hermitian by c = W^{1/2} v/sqrt(2 pi), which halves the
/// square at k = -N/2. It differs from the former by aliasing alone, which vanishes spectrally with N, and
/// its H is a full matrix.
///
/// Between walls (WaveBasis::walls, psi = 0 at both ends) there are polynomials instead, with mass and
/// stiffness from the action (wave/interval.hpp): H is a real symmetric matrix in c, and V enters through its
/// values at the points of the rule.
///
/// The state of a run is c, as 2N numbers (re, im in turn): |c|^2 is the norm squared, h sum |psi_j|^2 or u*
/// M u. A Hamiltonian is immutable and shared; work arrays come from the caller and hold N numbers.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

#include "engine/model/wave/fourier.hpp"
#include "engine/model/wave/potential.hpp"

namespace extremal {

class Interval;
enum class WaveBasis { fourier, convolution, walls };

class Hamiltonian {
public:
    /// nx and ny even on a periodic domain; a potential that does not depend on time and an interval but for
    /// WaveBasis::fourier. Throws InvalidScene (pointer /potential) where V is not finite at a node.
    Hamiltonian(const wave::Grid& grid, double hbar, double mass, wave::Potential potential,
                WaveBasis basis = WaveBasis::fourier);

    int size() const { return grid_.size(); }
    const wave::Grid& grid() const { return grid_; }
    bool isPlane() const { return grid_.isPlane(); }
    WaveBasis basis() const { return basis_; }
    bool isPeriodic() const { return basis_ != WaveBasis::walls; }
    /// Whether H is a part diagonal in c and a part diagonal at the nodes, each of which moves psi by phases
    /// alone.
    bool isSplit() const { return basis_ == WaveBasis::fourier; }
    double hbar() const { return hbar_; }
    double mass() const { return mass_; }
    /// Along x.
    const wave::Domain& domain() const { return grid_.x; }
    /// Of a periodic domain alone, as are kinetic() and the harmonics of V.
    const Fourier& fourier() const { return *fourier_; }
    /// Between walls alone: the reference element.
    const Interval& interval() const { return *interval_; }
    /// H in the coordinates of toReal(), where it is not split.
    const Eigen::MatrixXd& matrix() const { return matrix_; }
    /// The nodes along x; between walls those inside.
    const std::vector<double>& x() const { return x_; }
    /// The nodes along y; 0 on an interval.
    const std::vector<double>& y() const { return y_; }
    /// Values of psi at the nodes from c, and back; not in place.
    void toNodes(const Complex* c, Complex* psi) const;
    void toCoefficients(const Complex* psi, Complex* c) const;
    /// Orthonormal coordinates in which H is a real matrix: the inverse transform of c (psi_j sqrt(h) where H
    /// is split), or c itself between walls; and back, which uses v up.
    void toReal(const Complex* c, Complex* v) const;
    void fromReal(Complex* v, Complex* c) const;
    /// Values at the middles of `rows` equal cells from those at the nodes, between walls: (row, node).
    Eigen::MatrixXd resampling(int rows) const;
    /// hbar^2 |k|^2/2m by place in c.
    const std::vector<double>& kinetic() const { return kinetic_; }
    bool isTimeDependent() const { return potential_.isTimeDependent(); }
    /// V at the nodes, at t = 0 where it depends on time.
    const std::vector<double>& potential() const { return V_; }
    /// V at the nodes and t.
    void potentialAt(double t, double* V) const;
    /// On an interval: the largest a for which V has a harmonic exp(2 pi i a x/L) above round-off; of the
    /// samples, so at most N/2.
    int harmonics() const { return harmonics_; }
    /// Coefficients of V: V(x_j) = sum_a Vhat_a exp(2 pi i a j/N), in FFT order.
    const std::vector<Complex>& potentialHarmonics() const { return Vhat_; }

    /// The same operator on another grid of the same domain.
    std::shared_ptr<const Hamiltonian> withModes(int nx, int ny = 1) const;

    /// out = H c with these values of V, or where H is a matrix with its own.
    void apply(const double* V, const Complex* c, Complex* out, Complex* work) const;
    /// <H>/<1> at t.
    double energy(double t, const Complex* c) const;
    /// Bounds of the spectrum: min V and max V + max kinetic.
    double lowest() const { return lowest_; }
    double highest() const { return highest_; }

private:
    void onGrid();
    void onInterval();
    void findHarmonics();
    void convolve();

    wave::Grid grid_;
    double hbar_, mass_;
    wave::Potential potential_;
    WaveBasis basis_;

    std::optional<Fourier> fourier_;
    std::shared_ptr<const Interval> interval_;
    Eigen::MatrixXd matrix_;
    std::vector<double> x_, y_, kinetic_, V_;
    std::vector<Complex> Vhat_;
    int harmonics_ = 0;
    double lowest_ = 0, highest_ = 0;
};

inline const Complex* coefficients(const double* x) { return reinterpret_cast<const Complex*>(x); }
inline Complex* coefficients(double* x) { return reinterpret_cast<Complex*>(x); }

/// A wave function between walls for pictures, from its values at the nodes (all real parts, then all
/// imaginary parts): at `rows` equally spaced points and the walls. Nodes crowd at the walls and are far
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
