#pragma once

#include <sherd/fracture/crack_density/crack_density.h>
#include <sherd/fracture/degradation/degradation.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

/// The phase-field equation in one dimension, on uniform splines of maximal smoothness: small, exact, and independent
/// of the spline room.
namespace phase_field_1d
{

/// Values and first two derivatives of the degree + 1 B-splines that live on a knot span.
struct SplineValues
{
  int             first; ///< number of the first of them
  Eigen::MatrixXd N;     ///< shape=(3, degree + 1): value, first, second derivative
};

/// Uniform open-knot spline space on [start, end].
class SplineSpace
{
public:
  SplineSpace(const int degree, const double start, const double end, const int n_elements)
      : degree_(degree), n_elements_(n_elements), start_(start), h_((end - start) / n_elements)
  {
    for (int i = 0; i < n_elements + 2 * degree + 1; ++i)
      knots_.push_back(start + h_ * std::clamp(i - degree, 0, n_elements));
  }

  int    degree() const { return degree_; }
  int    n_elements() const { return n_elements_; }
  int    n_functions() const { return n_elements_ + degree_; }
  double element_start(const int e) const { return start_ + e * h_; }
  double h() const { return h_; }

  SplineValues values(const double x) const
  {
    const int e = std::clamp(static_cast<int>(std::floor((x - start_) / h_)), 0, n_elements_ - 1);
    return values(x, e);
  }

  /// @param e  the element x lies in.
  SplineValues values(const double x, const int e) const
  {
    // Functions of lower degree first; derivatives from the usual differences of them.
    std::vector<Eigen::VectorXd> levels;
    for (int p = 0; p <= degree_; ++p)
      levels.push_back(functions(p, x, e));
    SplineValues result{e, Eigen::MatrixXd::Zero(3, degree_ + 1)};
    result.N.row(0) = levels[degree_];
    result.N.row(1) = derivative(levels[degree_ - 1], degree_, e);
    if (degree_ > 1)
      result.N.row(2) = derivative(derivative(levels[degree_ - 2], degree_ - 1, e), degree_, e);
    return result;
  }

private:
  double knot(const int i) const { return knots_[i]; }

  /// The p + 1 functions of degree p on element e; their numbers in the full knot vector are e + degree - p, ...
  Eigen::VectorXd functions(const int p, const double x, const int e) const
  {
    Eigen::VectorXd N = Eigen::VectorXd::Ones(1);
    for (int q = 1; q <= p; ++q)
      {
        Eigen::VectorXd next = Eigen::VectorXd::Zero(q + 1);
        for (int k = 0; k < q; ++k)
          {
            const int    i     = e + degree_ - q + 1 + k; // number of the function of degree q - 1
            const double ratio = (x - knot(i)) / (knot(i + q) - knot(i));
            next[k] += (1. - ratio) * N[k];
            next[k + 1] += ratio * N[k];
          }
        N = next;
      }
    return N;
  }

  /// From values (or derivatives) of the p functions of degree p - 1 to the derivatives of those of degree p.
  Eigen::VectorXd derivative(const Eigen::VectorXd &lower, const int p, const int e) const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(p + 1);
    for (int k = 0; k < p; ++k)
      {
        const int    i     = e + degree_ - p + 1 + k;
        const double slope = p * lower[k] / (knot(i + p) - knot(i));
        result[k] -= slope;
        result[k + 1] += slope;
      }
    return result;
  }

  int                 degree_, n_elements_;
  double              start_, h_;
  std::vector<double> knots_;
};

struct QuadraturePoint
{
  double       x, weight;
  SplineValues shape;
};

/// The degree + 1 Gauss points of each element.
inline std::vector<QuadraturePoint> quadrature(const SplineSpace &space)
{
  const int       n      = space.degree() + 1;
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n); // Golub and Welsch
  for (int i = 1; i < n; ++i)
    jacobi(i, i - 1) = jacobi(i - 1, i) = i / std::sqrt(4. * i * i - 1.);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobi);

  std::vector<QuadraturePoint> points;
  for (int e = 0; e < space.n_elements(); ++e)
    for (int q = 0; q < n; ++q)
      {
        const double x = space.element_start(e) + .5 * space.h() * (1. + eigen.eigenvalues()[q]);
        points.push_back({x, space.h() * std::pow(eigen.eigenvectors()(0, q), 2), space.values(x, e)});
      }
  return points;
}

/// Matrix of int (local u v + c1 u' v' + c2 u'' v'') dx. For densities of second and fourth order, with local = 1 and
/// u = 1 - phi, energy / Gc = u^T K u / (4 l0).
template <sherd::CrackDensity Density>
Eigen::MatrixXd stiffness(const SplineSpace &space, const Density &density, const double l0, const double local = 1.)
{
  Eigen::MatrixXd       K      = Eigen::MatrixXd::Zero(space.n_functions(), space.n_functions());
  const int             n      = space.degree() + 1;
  const Eigen::Vector3d factor = {local, density.c1(l0), density.c2(l0)};
  for (const auto &q : quadrature(space))
    K.block(q.shape.first, q.shape.first, n, n) += q.weight * q.shape.N.transpose() * factor.asDiagonal() * q.shape.N;
  return K;
}

/// Least energy / Gc under the constraints B u = 1, where u = 1 - phi are coefficients and rows of B are given.
inline double constrained_energy(const Eigen::MatrixXd &K, const Eigen::MatrixXd &B, const Eigen::VectorXd &value,
                                 const double l0)
{
  const Eigen::MatrixXd schur = B * K.ldlt().solve(B.transpose());
  return value.dot(schur.ldlt().solve(value)) / (4. * l0);
}

struct Solution
{
  Eigen::VectorXd coefficients;     ///< of phi
  double          energy;           ///< int Psi_frac dx / Gc
  double          min_phi, max_phi; ///< over the quadrature points
  int             iterations;
};

/// Phase of a body in which the driving energy is history(x), by Newton's method from the coefficients of start(x).
template <sherd::CrackDensity Density, sherd::Degradation Function>
Solution solve(const SplineSpace &space, const Density &density, const Function &g, const double Gc, const double l0,
               const std::function<double(double)> &history, const std::function<double(double)> &start)
{
  const auto            points = quadrature(space);
  const double          local  = Gc / (4. * l0);
  const Eigen::MatrixXd K      = Gc / (2. * l0) * stiffness(space, density, l0, 0.);
  const int             n      = space.degree() + 1;

  // Start values by L2 projection.
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(K.rows(), K.rows());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(K.rows());
  for (const auto &q : points)
    {
      const auto N = q.shape.N.row(0);
      mass.block(q.shape.first, q.shape.first, n, n) += q.weight * N.transpose() * N;
      load.segment(q.shape.first, n) += q.weight * start(q.x) * N.transpose();
    }
  Solution result{mass.ldlt().solve(load), 0., 1., 0., 0};

  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(K.rows());
  for (double change = 1.; change > 1e-11; ++result.iterations)
    {
      if (result.iterations == 50)
        throw std::runtime_error("phase_field_1d: no convergence");
      Eigen::MatrixXd tangent  = K;
      Eigen::VectorXd residual = K * (result.coefficients - ones);
      for (const auto &q : points)
        {
          const auto   N   = q.shape.N.row(0);
          const double phi = N.dot(result.coefficients.segment(q.shape.first, n)), H = history(q.x);
          tangent.block(q.shape.first, q.shape.first, n, n) +=
              q.weight * (g.second(phi) * H + local * density.local_second(phi)) * N.transpose() * N;
          residual.segment(q.shape.first, n) +=
              q.weight * (g.first(phi) * H + local * density.local_first(phi)) * N.transpose();
        }
      const Eigen::VectorXd step = tangent.partialPivLu().solve(residual);
      result.coefficients -= step;
      change = step.cwiseAbs().maxCoeff();
    }

  const Eigen::VectorXd u = ones - result.coefficients;
  result.energy           = u.dot(K * u) / (2. * Gc);
  for (const auto &q : points)
    {
      const double phi = q.shape.N.row(0).dot(result.coefficients.segment(q.shape.first, n));
      result.min_phi   = std::min(result.min_phi, phi);
      result.max_phi   = std::max(result.max_phi, phi);
      result.energy += q.weight * density.local(phi) / (4. * l0);
    }
  return result;
}

} // namespace phase_field_1d
