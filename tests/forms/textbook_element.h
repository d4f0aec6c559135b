#pragma once

#include <array>

#include <forms/element_problem.h>

namespace sherd::test
{

/// Element force and tangent written down index by index from theory E.1 and E.2, in the coordinates of the patch, with
/// NURBS evaluated by the recurrence of Cox and de Boor. It shares with the library the knots, the Gauss rule and the
/// response of the material at a point.
struct TextbookElement
{
  Eigen::VectorXd force;
  Eigen::MatrixXd matrix;
};

template <class Model>
TextbookElement textbook_element(const Model &model, const Surface<Model::degree, 2> &surface, int element,
                                 const Eigen::VectorXd &y, const Eigen::VectorXd &acceleration,
                                 const std::vector<double> &history, double mass_weight)
{
  const auto  &patch     = surface.patch(0);
  const auto  &box       = patch.basis.element(element);
  const auto   functions = patch.basis.functions_of(element);
  const int    n         = static_cast<int>(functions.size());
  const auto  &gauss     = gauss_legendre(Model::degree + 1);
  const auto   voigt     = [](int a, int b) { return a == b ? a : 2; };
  const double l0        = model.length_scale;

  TextbookElement result{Eigen::VectorXd::Zero(3 * n), Eigen::MatrixXd::Zero(3 * n, 3 * n)};
  for (int q = 0; q < gauss.n_points * gauss.n_points; ++q)
    {
      const int    qu = q % gauss.n_points, qv = q / gauss.n_points;
      const double u = box.min[0] + gauss.points[qu] * box.size()[0];
      const double v = box.min[1] + gauss.points[qv] * box.size()[1];

      // R = w B / W and its derivatives.
      const auto                                        B = evaluate(patch.basis, element, u, v);
      double                                            W = 0.;
      std::array<double, 2>                             dW{};
      std::array<std::array<double, 2>, 2>              ddW{};
      std::vector<double>                               N(n);
      std::vector<std::array<double, 2>>                dN(n);
      std::vector<std::array<std::array<double, 2>, 2>> ddN(n);
      for (int A = 0; A < n; ++A)
        {
          const double w = patch.weights[functions[A]];
          W += w * B[A].value;
          for (int a = 0; a < 2; ++a)
            {
              dW[a] += w * B[A].first[a];
              for (int b = 0; b < 2; ++b)
                ddW[a][b] += w * B[A].second[voigt(a, b)];
            }
        }
      for (int A = 0; A < n; ++A)
        {
          const double w = patch.weights[functions[A]];
          N[A]           = w * B[A].value / W;
          for (int a = 0; a < 2; ++a)
            dN[A][a] = (w * B[A].first[a] - N[A] * dW[a]) / W;
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
              ddN[A][a][b] =
                  (w * B[A].second[voigt(a, b)] - dN[A][a] * dW[b] - dN[A][b] * dW[a] - N[A] * ddW[a][b]) / W;
        }

      // Reference surface: tangents, metric and Christoffel symbols.
      Eigen::Matrix2d reference = Eigen::Matrix2d::Zero(), current = reference; // columns: tangents
      Eigen::Vector2d X = Eigen::Vector2d::Zero(), inertia = X, second[2][2] = {{X, X}, {X, X}}, dphi = X;
      double          phi = 0.;
      for (int A = 0; A < n; ++A)
        {
          const Eigen::Vector2d XA = patch.control_points.row(functions[A]).transpose();
          X += N[A] * XA;
          phi += N[A] * y[3 * A + 2];
          inertia += N[A] * acceleration.segment<2>(3 * A);
          for (int a = 0; a < 2; ++a)
            {
              reference.col(a) += dN[A][a] * XA;
              current.col(a) += dN[A][a] * y.segment<2>(3 * A);
              dphi[a] += dN[A][a] * y[3 * A + 2];
              for (int b = 0; b < 2; ++b)
                second[a][b] += ddN[A][a][b] * XA;
            }
        }
      const Eigen::Matrix2d G    = reference.transpose() * reference;
      const Eigen::Matrix2d Ginv = G.inverse();
      const double          dA = std::abs(reference.determinant()) * box.area() * gauss.weights[qu] * gauss.weights[qv];
      double                christoffel[2][2][2] = {}; // [c][a][b]
      for (int c = 0; c < 2; ++c)
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b)
            for (int d = 0; d < 2; ++d)
              christoffel[c][a][b] += Ginv(c, d) * reference.col(d).dot(second[a][b]);
      std::vector<double> laplacian(n, 0.);
      double              laplacian_phi = 0.;
      for (int A = 0; A < n; ++A)
        {
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
              {
                laplacian[A] += Ginv(a, b) * ddN[A][a][b];
                for (int c = 0; c < 2; ++c)
                  laplacian[A] -= Ginv(a, b) * christoffel[c][a][b] * dN[A][c];
              }
          laplacian_phi += laplacian[A] * y[3 * A + 2];
        }

      // Material.
      const Eigen::Matrix2d g2       = current.transpose() * current;
      const auto            response = model.split.respond(SurfacePoint<2>(
          ReferencePoint<2>(metric(Voigt(G(0, 0), G(1, 1), G(0, 1)))), metric(Voigt(g2(0, 0), g2(1, 1), g2(0, 1)))));
      const double          g        = model.degradation.value(phi);
      const double          g_first  = model.degradation.first(phi);
      const double          g_second = model.degradation.second(phi);
      const bool            loading  = response.energy_active > history[q];
      const double          H        = loading ? response.energy_active : history[q];
      const double          Gc       = model.toughness(X);
      const double          c1       = model.crack_density.c1(l0);
      const double          c2       = model.crack_density.c2(l0);
      const auto            tau_plus = [&](int a, int b) { return response.stress_active.membrane[voigt(a, b)]; };
      const auto tau = [&](int a, int b) { return g * tau_plus(a, b) + response.stress_passive.membrane[voigt(a, b)]; };
      const auto c   = [&](int a, int b, int d, int e) {
        return g * response.tangent_active.membrane(voigt(a, b), voigt(d, e)) +
               response.tangent_passive.membrane(voigt(a, b), voigt(d, e));
      };

      for (int A = 0; A < n; ++A)
        {
          double &f_phi = result.force[3 * A + 2];
          f_phi += dA * (g_first * H * N[A] + Gc / (2. * l0) * (phi - 1.) * N[A]);
          f_phi += dA * Gc / (2. * l0) * c2 * laplacian[A] * laplacian_phi;
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
              f_phi += dA * Gc / (2. * l0) * c1 * Ginv(a, b) * dN[A][a] * dphi[b];
          for (int i = 0; i < 2; ++i)
            {
              result.force[3 * A + i] += dA * model.mass * N[A] * inertia[i];
              for (int a = 0; a < 2; ++a)
                for (int b = 0; b < 2; ++b)
                  result.force[3 * A + i] += dA * tau(a, b) * dN[A][a] * current(i, b);
            }

          for (int C = 0; C < n; ++C)
            {
              const auto k = [&](int i, int j) -> double & { return result.matrix(3 * A + i, 3 * C + j); };
              for (int i = 0; i < 2; ++i)
                {
                  k(i, i) += dA * mass_weight * model.mass * N[A] * N[C];
                  for (int a = 0; a < 2; ++a)
                    for (int b = 0; b < 2; ++b)
                      {
                        k(i, i) += dA * dN[A][a] * tau(a, b) * dN[C][b];
                        k(i, 2) += dA * g_first * tau_plus(a, b) * dN[A][a] * current(i, b) * N[C];
                        if (loading)
                          k(2, i) +=
                              dA * g_first * N[A] * response.driving.membrane[voigt(a, b)] * dN[C][a] * current(i, b);
                      }
                  for (int j = 0; j < 2; ++j)
                    for (int a = 0; a < 2; ++a)
                      for (int b = 0; b < 2; ++b)
                        for (int d = 0; d < 2; ++d)
                          for (int e = 0; e < 2; ++e)
                            k(i, j) += dA * c(a, b, d, e) * dN[A][a] * current(i, b) * current(j, d) * dN[C][e];
                }
              k(2, 2) += dA * (g_second * H + Gc / (2. * l0)) * N[A] * N[C];
              k(2, 2) += dA * Gc / (2. * l0) * c2 * laplacian[A] * laplacian[C];
              for (int a = 0; a < 2; ++a)
                for (int b = 0; b < 2; ++b)
                  k(2, 2) += dA * Gc / (2. * l0) * c1 * Ginv(a, b) * dN[A][a] * dN[C][b];
            }
        }
    }
  return result;
}

} // namespace sherd::test
