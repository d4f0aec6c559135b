#pragma once

#include <array>

#include <forms/element_problem.h>

namespace sherd::test
{

/// Element force and tangent written down index by index from theory A.1, E.1 and E.2, in the coordinates of the patch,
/// with NURBS evaluated by the recurrence of Cox and de Boor. It shares with the library the knots, the Gauss rule and
/// the response of the material at a point.
struct TextbookElement
{
  Eigen::VectorXd force;
  Eigen::MatrixXd matrix;
};

template <class Model>
TextbookElement textbook_element(const Model &model, const Surface<Model::degree, Model::spacedim> &surface,
                                 int element, const Eigen::VectorXd &y, const Eigen::VectorXd &acceleration,
                                 const std::vector<double> &history, double mass_weight)
{
  constexpr int dim      = Model::spacedim;
  constexpr int n_fields = dim + 1;
  using Vector           = Eigen::Matrix<double, dim, 1>;
  using Tangents         = Eigen::Matrix<double, dim, 2>; // columns: tangents

  const auto  &patch     = surface.patch(0);
  const auto  &box       = patch.basis.element(element);
  const auto   functions = patch.basis.functions_of(element);
  const int    n         = static_cast<int>(functions.size());
  const auto  &gauss     = gauss_legendre(Model::degree + 1);
  const auto   voigt     = [](int a, int b) { return a == b ? a : 2; };
  const double l0        = model.length_scale;

  TextbookElement result{Eigen::VectorXd::Zero(n_fields * n), Eigen::MatrixXd::Zero(n_fields * n, n_fields * n)};
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

      // Reference and deformed surface.
      Tangents        reference = Tangents::Zero(), current = reference;
      Vector          X = Vector::Zero(), inertia = X, second[2][2] = {{X, X}, {X, X}}, bent[2][2] = {{X, X}, {X, X}};
      Eigen::Vector2d dphi = Eigen::Vector2d::Zero();
      double          phi  = 0.;
      for (int A = 0; A < n; ++A)
        {
          const Vector XA = patch.control_points.row(functions[A]).transpose();
          const Vector xA = y.segment<dim>(n_fields * A);
          X += N[A] * XA;
          phi += N[A] * y[n_fields * A + dim];
          inertia += N[A] * acceleration.segment<dim>(n_fields * A);
          for (int a = 0; a < 2; ++a)
            {
              reference.col(a) += dN[A][a] * XA;
              current.col(a) += dN[A][a] * xA;
              dphi[a] += dN[A][a] * y[n_fields * A + dim];
              for (int b = 0; b < 2; ++b)
                {
                  second[a][b] += ddN[A][a][b] * XA;
                  bent[a][b] += ddN[A][a][b] * xA;
                }
            }
        }
      const Eigen::Matrix2d G    = reference.transpose() * reference;
      const Eigen::Matrix2d Ginv = G.inverse();
      const double          dA   = std::sqrt(G.determinant()) * box.area() * gauss.weights[qu] * gauss.weights[qv];
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
          laplacian_phi += laplacian[A] * y[n_fields * A + dim];
        }

      // Normal, dual tangents, curvature b_ab and N;ab of the deformed surface.
      const Eigen::Matrix2d                             g2   = current.transpose() * current;
      const Eigen::Matrix2d                             gInv = g2.inverse();
      const Tangents                                    dual = current * gInv;
      std::vector<std::array<std::array<double, 2>, 2>> covariant(n);
      Vector                                            normal = Vector::Zero();
      Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero(), reference_curvature = curvature;
      if constexpr (dim == 3)
        {
          normal                        = current.col(0).cross(current.col(1)).normalized();
          const Vector reference_normal = reference.col(0).cross(reference.col(1)).normalized();
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
              {
                curvature(a, b)           = bent[a][b].dot(normal);
                reference_curvature(a, b) = second[a][b].dot(reference_normal);
                for (int A = 0; A < n; ++A)
                  {
                    covariant[A][a][b] = ddN[A][a][b];
                    for (int c = 0; c < 2; ++c)
                      covariant[A][a][b] -= dual.col(c).dot(bent[a][b]) * dN[A][c];
                  }
              }
        }

      // Material.
      const auto   components = [](const Eigen::Matrix2d &t) { return Voigt(t(0, 0), t(1, 1), t(0, 1)); };
      const auto   response   = model.split.respond([&] {
        if constexpr (dim == 2)
          return SurfacePoint<2>(ReferencePoint<2>(metric(components(G))), metric(components(g2)));
        else
          return SurfacePoint<3>(ReferencePoint<3>(metric(components(G)), components(reference_curvature)),
                                 metric(components(g2)), components(curvature));
      }());
      const double g          = model.degradation.value(phi);
      const double g_first    = model.degradation.first(phi);
      const double g_second   = model.degradation.second(phi);
      const bool   loading    = response.energy_active > history[q];
      const double H          = loading ? response.energy_active : history[q];
      const double Gc         = model.toughness(X);
      const double c1         = model.crack_density.c1(l0);
      const double c2         = model.crack_density.c2(l0);
      const auto   tau_plus   = [&](int a, int b) { return response.stress_active.membrane[voigt(a, b)]; };
      const auto tau = [&](int a, int b) { return g * tau_plus(a, b) + response.stress_passive.membrane[voigt(a, b)]; };
      const auto entry = [&](const Voigt4 &active, const Voigt4 &passive, int a, int b, int d, int e) {
        return g * active(voigt(a, b), voigt(d, e)) + passive(voigt(a, b), voigt(d, e));
      };
      const auto c = [&](int a, int b, int d, int e) {
        return entry(response.tangent_active.membrane, response.tangent_passive.membrane, a, b, d, e);
      };

      const auto M_plus = [&](int a, int b) {
        if constexpr (dim == 3)
          return response.stress_active.moment[voigt(a, b)];
        else
          return 0.;
      };
      const auto M = [&](int a, int b) {
        if constexpr (dim == 3)
          return g * M_plus(a, b) + response.stress_passive.moment[voigt(a, b)];
        else
          return 0.;
      };
      // Everything in the row of point A and the column of point C that a membrane does not have.
      const auto add_bending = [&](int A, int C) {
        if constexpr (dim == 3)
          {
            const auto  k = [&](int i, int j) -> double  &{ return result.matrix(n_fields * A + i, n_fields * C + j); };
            const auto &active = response.tangent_active, &passive = response.tangent_passive;
            double      bM = 0., MA = 0., MC = 0.; // b_ab M^ab, M^ab N_A;ab, M^ab N_C;ab
            for (int a = 0; a < 2; ++a)
              for (int b = 0; b < 2; ++b)
                {
                  bM += curvature(a, b) * M(a, b);
                  MA += covariant[A][a][b] * M(a, b);
                  MC += covariant[C][a][b] * M(a, b);
                }
            for (int i = 0; i < 3; ++i)
              {
                for (int a = 0; a < 2; ++a)
                  for (int b = 0; b < 2; ++b)
                    {
                      k(i, 3) += dA * g_first * M_plus(a, b) * covariant[A][a][b] * normal[i] * N[C];
                      if (loading)
                        k(3, i) +=
                            dA * g_first * N[A] * response.driving.moment[voigt(a, b)] * covariant[C][a][b] * normal[i];
                    }
                for (int j = 0; j < 3; ++j)
                  {
                    for (int a = 0; a < 2; ++a)
                      for (int b = 0; b < 2; ++b)
                        for (int d = 0; d < 2; ++d)
                          for (int e = 0; e < 2; ++e)
                            {
                              k(i, j) += dA * entry(active.coupling, passive.coupling, a, b, d, e) * dN[A][a] *
                                         current(i, b) * normal[j] * covariant[C][d][e];
                              k(i, j) += dA * entry(active.moment_coupling, passive.moment_coupling, a, b, d, e) *
                                         covariant[A][a][b] * normal[i] * current(j, d) * dN[C][e];
                              k(i, j) += dA * entry(active.bending, passive.bending, a, b, d, e) * covariant[A][a][b] *
                                         normal[i] * normal[j] * covariant[C][d][e];
                            }
                    for (int d = 0; d < 2; ++d)
                      {
                        for (int e = 0; e < 2; ++e)
                          k(i, j) -= dA * bM * gInv(d, e) * dN[A][d] * dN[C][e] * normal[i] * normal[j];
                        k(i, j) -= dA * dN[A][d] * normal[i] * dual(j, d) * MC;
                        k(i, j) -= dA * MA * dual(i, d) * normal[j] * dN[C][d];
                      }
                  }
              }
          }
      };

      for (int A = 0; A < n; ++A)
        {
          double &f_phi = result.force[n_fields * A + dim];
          f_phi += dA * (g_first * H * N[A] + Gc / (2. * l0) * (phi - 1.) * N[A]);
          f_phi += dA * Gc / (2. * l0) * c2 * laplacian[A] * laplacian_phi;
          for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
              f_phi += dA * Gc / (2. * l0) * c1 * Ginv(a, b) * dN[A][a] * dphi[b];
          for (int i = 0; i < dim; ++i)
            {
              result.force[n_fields * A + i] += dA * model.mass * N[A] * inertia[i];
              for (int a = 0; a < 2; ++a)
                for (int b = 0; b < 2; ++b)
                  result.force[n_fields * A + i] += dA * tau(a, b) * dN[A][a] * current(i, b);
              if constexpr (dim == 3)
                for (int a = 0; a < 2; ++a)
                  for (int b = 0; b < 2; ++b)
                    result.force[n_fields * A + i] += dA * M(a, b) * covariant[A][a][b] * normal[i];
            }

          for (int C = 0; C < n; ++C)
            {
              const auto k = [&](int i, int j) -> double & {
                return result.matrix(n_fields * A + i, n_fields * C + j);
              };
              for (int i = 0; i < dim; ++i)
                {
                  k(i, i) += dA * mass_weight * model.mass * N[A] * N[C];
                  for (int a = 0; a < 2; ++a)
                    for (int b = 0; b < 2; ++b)
                      {
                        k(i, i) += dA * dN[A][a] * tau(a, b) * dN[C][b];
                        k(i, dim) += dA * g_first * tau_plus(a, b) * dN[A][a] * current(i, b) * N[C];
                        if (loading)
                          k(dim, i) +=
                              dA * g_first * N[A] * response.driving.membrane[voigt(a, b)] * dN[C][a] * current(i, b);
                      }
                  for (int j = 0; j < dim; ++j)
                    for (int a = 0; a < 2; ++a)
                      for (int b = 0; b < 2; ++b)
                        for (int d = 0; d < 2; ++d)
                          for (int e = 0; e < 2; ++e)
                            k(i, j) += dA * c(a, b, d, e) * dN[A][a] * current(i, b) * current(j, d) * dN[C][e];
                }
              if constexpr (dim == 3)
                add_bending(A, C);
              k(dim, dim) += dA * (g_second * H + Gc / (2. * l0)) * N[A] * N[C];
              k(dim, dim) += dA * Gc / (2. * l0) * c2 * laplacian[A] * laplacian[C];
              for (int a = 0; a < 2; ++a)
                for (int b = 0; b < 2; ++b)
                  k(dim, dim) += dA * Gc / (2. * l0) * c1 * Ginv(a, b) * dN[A][a] * dN[C][b];
            }
        }
    }
  return result;
}

} // namespace sherd::test
