// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/program_text.hpp"

namespace extremal::program_text {

const char* const cppHead = R"(#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

)";

const char* const cppDerivatives = R"(
/// The gradient of L in (q, v), and the lower triangle of its Hessian.
void fill([[maybe_unused]] double t, [[maybe_unused]] const double* q, [[maybe_unused]] const double* v, double* g, double (*H)[2 * d]) {
)";

const char* const cppByParameters = R"(}

/// The derivatives of this gradient by those parameters that the program differentiates by, by rows.
void fillByParameters([[maybe_unused]] double t, [[maybe_unused]] const double* q, [[maybe_unused]] const double* v, [[maybe_unused]] double* B) {
)";

const char* const cppCommon = R"(}

/// X of A X = B, column by column, by elimination with partial pivoting; n rows, k columns, both by rows.
bool solve(std::vector<double> A, std::vector<double>& B, int n, int k) {
    for (int c = 0; c < n; ++c) {
        int pivot = c;
        for (int r = c + 1; r < n; ++r)
            if (std::fabs(A[r * n + c]) > std::fabs(A[pivot * n + c])) pivot = r;
        if (A[pivot * n + c] == 0) return false;
        for (int j = 0; j < n; ++j) std::swap(A[c * n + j], A[pivot * n + j]);
        for (int j = 0; j < k; ++j) std::swap(B[c * k + j], B[pivot * k + j]);
        for (int r = 0; r < n; ++r) {
            if (r == c || A[r * n + c] == 0) continue;
            const double factor = A[r * n + c] / A[c * n + c];
            for (int j = c; j < n; ++j) A[r * n + j] -= factor * A[c * n + j];
            for (int j = 0; j < k; ++j) B[r * k + j] -= factor * B[c * k + j];
        }
    }
    for (int r = 0; r < n; ++r)
        for (int j = 0; j < k; ++j) B[r * k + j] /= A[r * n + r];
    return true;
}

double largest(const std::vector<double>& x) {
    double most = 0;
    for (const double each : x) most = std::max(most, std::fabs(each));
    return most;
}

struct Derivatives {
    double g[2 * d], H[2 * d][2 * d];
};
Derivatives derivatives(double t, const double* q, const double* v) {
    Derivatives L;
    fill(t, q, v, L.g, L.H);
    for (int i = 0; i < 2 * d; ++i)
        for (int j = i + 1; j < 2 * d; ++j) L.H[i][j] = L.H[j][i];
    return L;
}

/// Of the gradient of L, with the columns of derivatives of q and v: rows of N.
std::vector<double> changes(double t, const double* q, const double* v, const double* dq, const double* dv) {
    const Derivatives L = derivatives(t, q, v);
    std::vector<double> B(2 * d * u + 1), G(2 * d * N, 0.0);
    fillByParameters(t, q, v, B.data());
    for (int i = 0; i < 2 * d; ++i)
        for (int l = 0; l < N; ++l) {
            double sum = 0;
            for (int j = 0; j < d; ++j) sum += L.H[i][j] * dq[j * N + l] + L.H[i][d + j] * dv[j * N + l];
            for (int k = 0; k < u; ++k) sum += B[i * u + k] * d_parameters[k][l];
            G[i * N + l] = sum;
        }
    return G;
}

/// v with L_v(t, q, v) = p, by Newton from 0: one iteration where L is quadratic in v.
std::vector<double> velocity(double t, const std::vector<double>& q, const std::vector<double>& p) {
    std::vector<double> v(d, 0.0);
    for (int iteration = 0; iteration < 60; ++iteration) {
        const Derivatives L = derivatives(t, q.data(), v.data());
        std::vector<double> M(d * d), r(d);
        for (int i = 0; i < d; ++i) {
            r[i] = p[i] - L.g[d + i];
            for (int j = 0; j < d; ++j) M[i * d + j] = L.H[d + i][d + j];
        }
        if (!solve(M, r, d, 1)) throw std::runtime_error("the Legendre transform is singular");
        for (int i = 0; i < d; ++i) v[i] += r[i];
        if (largest(r) <= 1e-15 * largest(v)) break;
    }
    return v;
}

// Each step also moves X, the columns of derivatives of (q, p) by numbers of the scene, if it is given: 2 d rows of N.
)";

const char* const cppGalerkin = R"(
/// sum_i b_i (h psi_a L_q + psi_a' L_v) = 0 inside, = -p_0 for the last test function; Newton from a straight line.
void step(double t, double h, std::vector<double>& q0, std::vector<double>& p0, std::vector<double>* X = nullptr) {
    const std::vector<double> v0 = velocity(t, q0, p0);
    std::vector<double> Y(m * d), Q(d), V(d);
    for (int k = 0; k < d; ++k) Y[(m - 1) * d + k] = h * v0[k];
    const auto at = [&](int i) {
        for (int k = 0; k < d; ++k) {
            Q[k] = q0[k];
            V[k] = 0;
            for (int a = 0; a < m; ++a) {
                Q[k] += phi[i][a] * Y[a * d + k];
                V[k] += dphi[i][a] * Y[a * d + k] / h;
            }
        }
        return derivatives(t + c[i] * h, Q.data(), V.data());
    };
    const auto jacobian = [&](const Derivatives& L, int i, std::vector<double>& J) {
        for (int a = 0; a < m; ++a)
            for (int j = 0; j < d; ++j)
                for (int e = 0; e < m; ++e)
                    for (int k = 0; k < d; ++k)
                        J[(a * d + j) * m * d + e * d + k] +=
                            b[i] * (psi[i][a] * (h * L.H[j][k] * phi[i][e] + L.H[j][d + k] * dphi[i][e]) +
                                    dpsi[i][a] * (L.H[d + j][k] * phi[i][e] + L.H[d + j][d + k] * dphi[i][e] / h));
    };
    // With the equations R(Y; q_0, p_0, k) = 0 of the step: R_Y dY = -R_q dq_0 - R_p dp_0 - R_k dk.
    const auto moveColumns = [&] {
        const std::vector<double> before = *X, rest(d * N, 0.0);
        std::vector<double> dY(m * d * N, 0.0), J(m * d * m * d, 0.0);
        for (int k = 0; k < d * N; ++k) dY[(m - 1) * d * N + k] = -before[d * N + k];
        for (int i = 0; i < n; ++i) {
            jacobian(at(i), i, J);
            const std::vector<double> G = changes(t + c[i] * h, Q.data(), V.data(), before.data(), rest.data());
            for (int a = 0; a < m; ++a)
                for (int k = 0; k < d * N; ++k)
                    dY[a * d * N + k] -= b[i] * (h * psi[i][a] * G[k] + dpsi[i][a] * G[d * N + k]);
        }
        if (!solve(J, dY, m * d, N)) throw std::runtime_error("the step is singular");
        for (int k = 0; k < d * N; ++k) (*X)[k] += dY[(m - 1) * d * N + k];
        for (int i = 0; i < n; ++i) {
            at(i);
            std::vector<double> dQ(before.begin(), before.begin() + d * N), dV(d * N, 0.0);
            for (int k = 0; k < d * N; ++k)
                for (int a = 0; a < m; ++a) {
                    dQ[k] += phi[i][a] * dY[a * d * N + k];
                    dV[k] += dphi[i][a] * dY[a * d * N + k] / h;
                }
            const std::vector<double> G = changes(t + c[i] * h, Q.data(), V.data(), dQ.data(), dV.data());
            for (int k = 0; k < d * N; ++k) (*X)[d * N + k] += h * b[i] * G[k];
        }
    };
    double last = HUGE_VAL;
    for (int iteration = 0; iteration < 60; ++iteration) {
        std::vector<double> R(m * d), J(m * d * m * d);
        for (int k = 0; k < d; ++k) R[(m - 1) * d + k] = -p0[k];
        for (int i = 0; i < n; ++i) {
            const Derivatives L = at(i);
            for (int a = 0; a < m; ++a)
                for (int j = 0; j < d; ++j) R[a * d + j] -= b[i] * (h * psi[i][a] * L.g[j] + dpsi[i][a] * L.g[d + j]);
            jacobian(L, i, J);
        }
        if (!solve(J, R, m * d, 1)) throw std::runtime_error("the step is singular");
        for (int a = 0; a < m * d; ++a) Y[a] += R[a];
        const double size = largest(R), scale = std::max(largest(Y), largest(q0));
        if (size <= 1e-16 * scale || (size < 1e-11 * scale && size >= last / 4)) {
            std::vector<double> force(d, 0.0);
            for (int i = 0; i < n; ++i) {
                const Derivatives L = at(i);
                for (int k = 0; k < d; ++k) force[k] += b[i] * L.g[k];
            }
            if (X) moveColumns();
            for (int k = 0; k < d; ++k) {
                q0[k] += Y[(m - 1) * d + k];
                p0[k] += h * force[k];
            }
            return;
        }
        last = size;
    }
    throw std::runtime_error("the step does not converge");
}
)";

const char* const cppStages = R"(
/// Stages in the order in which they are known: forces at Q_i, velocities at P_j.
void step(double t, double h, std::vector<double>& q0, std::vector<double>& p0, std::vector<double>* X = nullptr) {
    using Rows = std::vector<std::vector<double>>;
    Rows V(nV, std::vector<double>(d, 0.0)), F(nF, std::vector<double>(d, 0.0));
    Rows dV(nV, std::vector<double>(X ? d * N : 0)), dF(nF, std::vector<double>(X ? 2 * d * N : 0));
    const std::vector<double> rest(d, 0.0), none(X ? d * N : 0);
    for (const auto& stage : order) {
        const int i = stage[1];
        if (stage[0] == 1) {
            std::vector<double> P = p0;
            for (int j = 0; j < nF; ++j)
                for (int k = 0; k < d; ++k) P[k] += h * A_hat[i][j] * F[j][k];
            V[i] = velocity(t + c[i] * h, q0, P);
            if (!X) continue;
            const Derivatives L = derivatives(t + c[i] * h, q0.data(), V[i].data());
            const std::vector<double> G = changes(t + c[i] * h, q0.data(), V[i].data(), X->data(), none.data());
            std::vector<double> M(d * d);
            for (int k = 0; k < d; ++k)
                for (int j = 0; j < d; ++j) M[k * d + j] = L.H[d + k][d + j];
            for (int k = 0; k < d * N; ++k) {
                dV[i][k] = (*X)[d * N + k] - G[d * N + k];
                for (int j = 0; j < nF; ++j) dV[i][k] += h * A_hat[i][j] * dF[j][k];
            }
            if (!solve(M, dV[i], d, N)) throw std::runtime_error("the Legendre transform is singular");
        } else {
            std::vector<double> Q = q0;
            for (int j = 0; j < nV; ++j)
                for (int k = 0; k < d; ++k) Q[k] += h * A[i][j] * V[j][k];
            const Derivatives L = derivatives(t + c_hat[i] * h, Q.data(), rest.data());
            for (int k = 0; k < d; ++k) F[i][k] = L.g[k];
            if (!X) continue;
            std::vector<double> dQ(X->begin(), X->begin() + d * N);
            for (int j = 0; j < nV; ++j)
                for (int k = 0; k < d * N; ++k) dQ[k] += h * A[i][j] * dV[j][k];
            dF[i] = changes(t + c_hat[i] * h, Q.data(), rest.data(), dQ.data(), none.data());
        }
    }
    for (int k = 0; X && k < d * N; ++k) {
        for (int j = 0; j < nV; ++j) (*X)[k] += h * b[j] * dV[j][k];
        for (int j = 0; j < nF; ++j) (*X)[d * N + k] += h * b_hat[j] * dF[j][k];
    }
    for (int k = 0; k < d; ++k) {
        for (int j = 0; j < nV; ++j) q0[k] += h * b[j] * V[j][k];
        for (int j = 0; j < nF; ++j) p0[k] += h * b_hat[j] * F[j][k];
    }
}
)";

const char* const cppRungeKutta = R"(
/// Hamilton's vector field and its Jacobian, from L: p = L_v, p' = L_q.
void field(double t, const std::vector<double>& q, const std::vector<double>& p, double* f, double* J) {
    const std::vector<double> v = velocity(t, q, p);
    const Derivatives L = derivatives(t, q.data(), v.data());
    std::vector<double> M(d * d), W(d * 2 * d);  // dv = M^-1 (dp - L_vq dq)
    for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j) {
            M[i * d + j] = L.H[d + i][d + j];
            W[i * 2 * d + j] = -L.H[d + i][j];
            W[i * 2 * d + d + j] = i == j ? 1 : 0;
        }
    if (!solve(M, W, d, 2 * d)) throw std::runtime_error("the Legendre transform is singular");
    for (int i = 0; i < d; ++i) {
        f[i] = v[i];
        f[d + i] = L.g[i];
        for (int j = 0; j < 2 * d; ++j) {
            J[i * 2 * d + j] = W[i * 2 * d + j];
            double sum = j < d ? L.H[i][j] : 0;
            for (int k = 0; k < d; ++k) sum += L.H[i][d + k] * W[k * 2 * d + j];
            J[(d + i) * 2 * d + j] = sum;
        }
    }
}

/// The derivatives of the field by the numbers through the parameters: rows of N.
std::vector<double> fieldByParameters(double t, const std::vector<double>& q, const std::vector<double>& p) {
    const std::vector<double> v = velocity(t, q, p), none(d * N, 0.0);
    const Derivatives L = derivatives(t, q.data(), v.data());
    std::vector<double> G = changes(t, q.data(), v.data(), none.data(), none.data());
    std::vector<double> M(d * d), W(G.begin() + d * N, G.end());
    for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j) M[i * d + j] = -L.H[d + i][d + j];
    if (!solve(M, W, d, N)) throw std::runtime_error("the Legendre transform is singular");
    for (int i = 0; i < d; ++i)
        for (int l = 0; l < N; ++l) {
            for (int j = 0; j < d; ++j) G[i * N + l] += L.H[i][d + j] * W[j * N + l];
            G[(d + i) * N + l] = G[i * N + l];
            G[i * N + l] = W[i * N + l];
        }
    return G;
}

/// K_i = f(x_0 + h sum_j a_ij K_j), with A for q and A_hat for p: stage by stage, or by Newton for all.
void step(double t, double h, std::vector<double>& q0, std::vector<double>& p0, std::vector<double>* X = nullptr) {
    constexpr int w = 2 * d;
    std::vector<double> K(nV * w, 0.0), f(w), J(w * w), Q(d), P(d);
    const auto at = [&](int i) {
        Q = q0;
        P = p0;
        for (int j = 0; j < nV; ++j)
            for (int k = 0; k < d; ++k) {
                Q[k] += h * A[i][j] * K[j * w + k];
                P[k] += h * A_hat[i][j] * K[j * w + d + k];
            }
        field(t + c[i] * h, Q, P, f.data(), J.data());
    };
    if (is_explicit) {
        for (int i = 0; i < nV; ++i) {
            at(i);
            for (int k = 0; k < w; ++k) K[i * w + k] = f[k];
        }
    } else {
        field(t, q0, p0, f.data(), J.data());
        for (int i = 0; i < nV; ++i)
            for (int k = 0; k < w; ++k) K[i * w + k] = f[k];
        double last = HUGE_VAL;
        for (int iteration = 0;; ++iteration) {
            if (iteration == 60) throw std::runtime_error("the step does not converge");
            std::vector<double> R(nV * w), M(nV * w * nV * w, 0.0);
            for (int i = 0; i < nV; ++i) {
                at(i);
                for (int k = 0; k < w; ++k) {
                    R[i * w + k] = f[k] - K[i * w + k];
                    for (int j = 0; j < nV; ++j)
                        for (int l = 0; l < w; ++l)
                            M[(i * w + k) * nV * w + j * w + l] =
                                (i == j && k == l ? 1 : 0) - h * (l < d ? A[i][j] : A_hat[i][j]) * J[k * w + l];
                }
            }
            if (!solve(M, R, nV * w, 1)) throw std::runtime_error("the step is singular");
            for (int k = 0; k < nV * w; ++k) K[k] += R[k];
            const double size = largest(R), scale = largest(K);
            if (size <= 1e-16 * scale || (size < 1e-11 * scale && size >= last / 4)) break;
            last = size;
        }
    }
    // dK_i = J_i (dx_0 + h sum_j a_ij dK_j) + f_k dk.
    if (X) {
        std::vector<double> M(nV * w * nV * w), dK(nV * w * N);
        for (int i = 0; i < nV; ++i) {
            at(i);
            const std::vector<double> G = fieldByParameters(t + c[i] * h, Q, P);
            for (int k = 0; k < w; ++k) {
                for (int l = 0; l < N; ++l) {
                    double sum = G[k * N + l];
                    for (int e = 0; e < w; ++e) sum += J[k * w + e] * (*X)[e * N + l];
                    dK[(i * w + k) * N + l] = sum;
                }
                for (int j = 0; j < nV; ++j)
                    for (int l = 0; l < w; ++l)
                        M[(i * w + k) * nV * w + j * w + l] =
                            (i == j && k == l ? 1 : 0) - h * (l < d ? A[i][j] : A_hat[i][j]) * J[k * w + l];
            }
        }
        if (!solve(M, dK, nV * w, N)) throw std::runtime_error("the step is singular");
        for (int j = 0; j < nV; ++j)
            for (int k = 0; k < w * N; ++k) (*X)[k] += h * (k < d * N ? b[j] : b_hat[j]) * dK[j * w * N + k];
    }
    for (int j = 0; j < nV; ++j)
        for (int k = 0; k < d; ++k) {
            q0[k] += h * b[j] * K[j * w + k];
            p0[k] += h * b_hat[j] * K[j * w + d + k];
        }
}
)";

const char* const cppMain = R"(
/// To the next node.
void advance(long k, std::vector<double>& q, std::vector<double>& p, std::vector<double>* X = nullptr) {
    double at = t_start + double(k) * h_step;
    for (const double part : parts) {
        step(at, part * h_step, q, p, X);
        at += part * h_step;
    }
}

/// The derivatives of (q, p) after so many steps by the numbers: 2 d rows of N.
std::vector<double> derivative(long steps) {
    std::vector<double> q(q_start, q_start + d), p(p_start, p_start + d), X(2 * d * N);
    for (int i = 0; i < 2 * d; ++i) std::copy(d_start[i], d_start[i] + N, X.begin() + i * N);
    for (long k = 0; k < steps; ++k) advance(k, q, p, &X);
    return X;
}

/// Largest difference from the rows of a CSV of the run, relative to the largest entry of the state.
bool test(const char* path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line) || line.rfind(columns, 0) != 0)
        throw std::runtime_error(std::string("the columns must begin with ") + columns);
    std::vector<double> q(q_start, q_start + d), p(p_start, p_start + d);
    long k = 0, rows = 0;
    double worst = 0, scale = 0;
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::string cell;
        std::vector<double> x;
        while (x.size() < 1 + 2 * d && std::getline(cells, cell, ',')) {
            x.push_back(0);
            std::istringstream(cell) >> x.back();
        }
        for (const long node = std::lround((x[0] - t_start) / h_step); k < node; ++k) advance(k, q, p);
        scale = std::max({scale, largest(q), largest(p)});
        for (int i = 0; i < d; ++i)
            worst = std::max({worst, std::fabs(q[i] - x[1 + i]), std::fabs(p[i] - x[1 + d + i])});
        ++rows;
    }
    std::printf("%ld rows, largest difference %.2e of %.3g\n", rows, worst, scale);
    return worst <= 1e-13 * scale;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && std::string(argv[1]) == "--derivative") {
        const std::vector<double> X = derivative(steps_of_the_scene);
        std::printf("column,%s\n", numbers);
        std::istringstream names(columns);
        std::string name;
        std::getline(names, name, ',');  // the time
        for (int i = 0; i < 2 * d && std::getline(names, name, ','); ++i) {
            std::printf("%s", name.c_str());
            for (int l = 0; l < N; ++l) std::printf(",%.17g", X[i * N + l]);
            std::printf("\n");
        }
        return 0;
    }
    if (argc > 1) return test(argv[1]) ? 0 : 1;
    std::vector<double> q(q_start, q_start + d), p(p_start, p_start + d);
    std::printf("%s\n", columns);
    for (long k = 0; k <= steps_of_the_scene; ++k) {
        std::printf("%.17g", t_start + double(k) * h_step);
        for (const double x : q) std::printf(",%.17g", x);
        for (const double x : p) std::printf(",%.17g", x);
        std::printf("\n");
        if (k < steps_of_the_scene) advance(k, q, p);
    }
}
)";

}  // namespace extremal::program_text
