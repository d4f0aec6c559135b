#pragma once

#include <sherd/forms/interface_tables.h>
#include <sherd/verify/random_state.h>

/// Pieces of interfaces for tests of forms.
namespace sherd::test
{

/// Two curved elements that share three control points, with tables of slopes drawn at random: along the interface only
/// the shared points have one, the same on both sides but for its sign. The sides meet in a fold that varies.
struct RandomInterface
{
  static constexpr int n = 15, n_across = 6, n_shared = 3;

  InterfaceTables<2, 3> piece;
  ControlValues<3>      X; ///< of the reference surface

  explicit RandomInterface(unsigned seed, double fold = .4) : X(n, 3)
  {
    verify::RandomNumbers random(seed);
    for (int i = 0; i < n; ++i)
      piece.points.push_back(i);
    // Points 0..5: first side, x < 0; 6..8: shared, x = 0; 9..14: second side, lifted by the fold.
    for (int A = 0; A < n; ++A)
      {
        const bool   second = A >= n_across + n_shared, shared = A >= n_across && !second;
        const double across = shared ? 0. : (A % 2 + 1.) / 2.;
        X.row(A) << (second ? std::cos(fold) : -1.) * across, (A % n_shared) / 2.,
            second ? std::sin(fold) * across : 0.;
        for (int d = 0; d < 3; ++d)
          X(A, d) += random(-.1, .1);
      }
    piece.along = 1;
    for (auto &point : piece.quadrature)
      {
        point.dS     = random(.2, .6);
        point.slopes = Eigen::MatrixXd::Zero(4, n);
        point.jump   = Eigen::VectorXd::Zero(n);
        for (int A = 0; A < n_across + n_shared; ++A)
          {
            point.slopes(0, A)         = (A < n_across ? -.3 : .3) * random(.5, 1.5);
            point.slopes(2, n - 1 - A) = (A < n_across ? .3 : -.3) * random(.5, 1.5);
            point.jump[A]              = random(-1., 1.);
          }
        // Constant fields have no slope; along the curve y grows with the point.
        point.slopes(1, 6)  = -1.1;
        point.slopes(1, 7)  = random(-.2, .2);
        point.slopes(1, 8)  = 1.1 - point.slopes(1, 7);
        point.slopes.row(3) = -point.slopes.row(1);
        for (const int row : {0, 2})
          point.slopes.row(row).segment<n_shared>(n_across).array() -= point.slopes.row(row).sum() / n_shared;
        piece.length += point.dS;
      }
    for (int q = 0; q < 3; ++q)
      piece.quadrature[q].reference = fold_angle(internal::fold_variables(piece, X, q));
  }
};

} // namespace sherd::test
