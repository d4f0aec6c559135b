// label: unit
#include <catch2/catch.hpp>

#include <forms/interface_pieces.h>
#include <forms/loaded_surfaces.h>
#include <sherd/forms/interface_angle.h>
#include <sherd/forms/interface_phase.h>
#include <sherd/verify/derivative.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

FoldVariables random_variables(verify::RandomNumbers &random)
{
  FoldVariables y;
  for (int i = 0; i < y.size(); ++i)
    y(i) = random(-1., 1.);
  y.col(0) += Point<3>(2., 0., 0.); // away from degenerate tangents
  y.col(1) += Point<3>(0., 2., 0.);
  y.col(2) += Point<3>(2., 0., 1.);
  y.col(3) += Point<3>(0., 2., 0.);
  y.col(4) += Point<3>(0., 2., 0.);
  return y;
}

ControlValues<3> direction(unsigned seed)
{
  return disturbed(ControlValues<3>::Zero(RandomInterface::n, 3), 1., seed);
}

Eigen::Map<const Eigen::VectorXd> flat(const ControlValues<3> &values)
{
  return {values.data(), values.size()};
}

} // namespace

TEST_CASE("fold angle: is the one by which the second surface is turned about the curve")
{
  const Eigen::Matrix3d R = rotation();
  for (const double angle : {0., .3, M_PI / 4., 1.2, -.8, 2.5})
    {
      const Eigen::Matrix3d fold = Eigen::AngleAxisd(angle, Point<3>::UnitY()).toRotationMatrix();
      FoldVariables         y;
      y.col(0)         = R * Point<3>(1.3, .4, 0.); // skew parameter lines on both sides
      y.col(1)         = R * Point<3>(0., .7, 0.);
      y.col(2)         = R * fold * Point<3>(.6, -.5, 0.);
      y.col(3)         = R * Point<3>(0., 1.1, 0.);
      y.col(4)         = R * Point<3>(0., .7, 0.);
      const auto found = fold_angle(y);
      CHECK(std::atan2(found.sine, found.cosine) == Approx(angle).margin(1e-15));
      CHECK(found.sine * found.sine + found.cosine * found.cosine == Approx(1.).epsilon(1e-14));
    }
}

TEST_CASE("fold angle: gradient and Hessian of cosine and sine in fifteen variables")
{
  verify::RandomNumbers random(3);
  for (int trial = 0; trial < 10; ++trial)
    {
      const FoldVariables y = random_variables(random), dy = random_variables(random);
      for (const CosineSine w : {CosineSine{1., 0.}, CosineSine{0., 1.}, CosineSine{-.7, 1.9}})
        {
          const auto value = [&](double h) {
            const auto found = fold_angle(y + h * dy);
            return w.cosine * found.cosine + w.sine * found.sine;
          };
          const double slope = fold_gradient(y, w).cwiseProduct(dy).sum();
          CHECK(verify::check_derivative(value, slope).passed());

          const auto        gradient = [&](double h) { return fold_gradient(FoldVariables(y + h * dy), w); };
          const FoldHessian H        = fold_hessian(y, w);
          const Eigen::Map<const Eigen::Matrix<double, 15, 1>> d(dy.data());
          const Eigen::Matrix<double, 15, 1>                   Hd = H * d;
          CHECK(verify::check_derivative(gradient, FoldVariables(Eigen::Map<const FoldVariables>(Hd.data()))).passed());
          CHECK((H - H.transpose()).cwiseAbs().maxCoeff() <= 1e-13 * H.cwiseAbs().maxCoeff());
        }
    }
}

TEST_CASE("angle between patches: penalty and multiplier derive from their energies")
{
  for (const double fold : {0., .3, M_PI / 4., 1.2})
    {
      const RandomInterface at(7, fold);
      const auto            x = disturbed(at.X, .05, 11), dx = direction(12);

      const auto energy = [&](double h) { return angle_penalty_energy(at.piece, ControlValues<3>(x + h * dx), 3.); };
      const auto force  = angle_penalty_force(at.piece, x, 3.);
      CHECK(verify::check_derivative(energy, force.cwiseProduct(dx).sum()).passed());
      const auto force_at = [&](double h) -> Eigen::VectorXd {
        return flat(angle_penalty_force(at.piece, ControlValues<3>(x + h * dx), 3.));
      };
      const Eigen::VectorXd tangent = angle_penalty_tangent(at.piece, x, 3.) * flat(dx);
      CHECK(verify::check_derivative(force_at, tangent).passed());

      const auto defect = [&](double h) { return angle_defect(at.piece, ControlValues<3>(x + h * dx)); };
      CHECK(verify::check_derivative(defect, angle_defect_gradient(at.piece, x).cwiseProduct(dx).sum()).passed());
      const auto row = [&](double h) -> Eigen::VectorXd {
        return -.6 * flat(angle_defect_gradient(at.piece, ControlValues<3>(x + h * dx)));
      };
      const Eigen::VectorXd of_multiplier = angle_multiplier_tangent(at.piece, x, -.6) * flat(dx);
      CHECK(verify::check_derivative(row, of_multiplier).passed());
    }
}

TEST_CASE("angle between patches: a folded reference and its rigid motions are free of force")
{
  for (const double fold : {0., .3, M_PI / 4., 1.2})
    {
      const RandomInterface at(19, fold);
      const double          scale = angle_penalty_force(at.piece, disturbed(at.X, .1, 2), 1.).norm();
      ControlValues<3>      moved = at.X * rotation().transpose();
      moved.rowwise() += Eigen::RowVector3d(3., -1., 2.);
      for (const auto &x : {at.X, moved})
        {
          CHECK(angle_penalty_force(at.piece, x, 1.).norm() <= 1e-13 * scale);
          CHECK(std::abs(angle_defect(at.piece, x)) <= 1e-14 * at.piece.length);
          CHECK(angle_penalty_energy(at.piece, x, 1.) <= 1e-26 * at.piece.length);
        }
    }
}

TEST_CASE("angle between patches: does not depend on the frame, and its force moves no body")
{
  const RandomInterface at(23);
  const auto            x = disturbed(at.X, .1, 5);
  const Eigen::Matrix3d R = rotation();
  const auto            f = angle_penalty_force(at.piece, x, 2.);
  CHECK((angle_penalty_force(at.piece, ControlValues<3>(x * R.transpose()), 2.) - f * R.transpose()).norm() <=
        1e-13 * f.norm());
  Point<3> moment = Point<3>::Zero();
  for (int A = 0; A < x.rows(); ++A)
    moment += Point<3>(x.row(A)).cross(Point<3>(f.row(A)));
  CHECK(f.colwise().sum().norm() <= 1e-14 * f.norm() * x.rows());
  CHECK(moment.norm() <= 1e-13 * f.norm());
}

TEST_CASE("angle between patches: a turn of one side about the curve costs eps (1 - cos) and opens the defect by sin")
{
  // A straight common curve, so that one side can turn about it.
  RandomInterface at(29, .5);
  for (int A = 6; A < 9; ++A)
    at.X.row(A) << 0., A - 7., 0.;
  for (int q = 0; q < 3; ++q)
    at.piece.quadrature[q].reference = fold_angle(internal::fold_variables(at.piece, at.X, q));
  const double turn = .2;
  auto         x    = at.X;
  x.bottomRows<6>() = at.X.bottomRows<6>() * Eigen::AngleAxisd(turn, Point<3>::UnitY()).toRotationMatrix().transpose();
  CHECK(angle_penalty_energy(at.piece, x, 3.) == Approx(3. * (1. - std::cos(turn)) * at.piece.length).epsilon(1e-12));
  CHECK(angle_defect(at.piece, x) == Approx(std::sin(turn) * at.piece.length).epsilon(1e-12));
}

TEST_CASE("continuity of the phase: matrix and row of the penalty and the multiplier")
{
  const RandomInterface       at(31);
  const std::array<double, 3> stiffness{2., .5, 1.};
  verify::RandomNumbers       random(4);
  Eigen::VectorXd             phi(RandomInterface::n);
  for (auto &value : phi)
    value = random(0., 1.);
  double energy = 0., jump = 0.;
  for (int q = 0; q < 3; ++q)
    {
      const double g = at.piece.quadrature[q].jump.dot(phi);
      energy += .5 * stiffness[q] * at.piece.quadrature[q].dS * g * g;
      jump += at.piece.quadrature[q].dS * g;
    }
  CHECK(.5 * phi.dot(phase_penalty_matrix(at.piece, stiffness) * phi) == Approx(energy).epsilon(1e-13));
  CHECK(phase_jump(at.piece).dot(phi) == Approx(jump).epsilon(1e-13));
}

TEST_CASE("interfaces: values that do not belong to the piece are refused")
{
  const RandomInterface  at(37);
  const ControlValues<3> short_one = at.X.topRows(4);
  CHECK_THROWS_AS(angle_defect(at.piece, short_one), DimensionMismatch);
  CHECK_THROWS_AS(angle_penalty_energy(at.piece, short_one, 1.), DimensionMismatch);
  CHECK_THROWS_AS(angle_penalty_force(at.piece, short_one, 1.), DimensionMismatch);
  CHECK_THROWS_AS(angle_multiplier_tangent(at.piece, short_one, 1.), DimensionMismatch);
}
