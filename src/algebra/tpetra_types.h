#pragma once

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Operator.hpp>

namespace sherd::tpetra
{

using Scalar      = double;
using Local       = int;
using Global      = long long;
using Map         = Tpetra::Map<Local, Global>;
using Node        = Map::node_type;
using MultiVector = Tpetra::MultiVector<Scalar, Local, Global, Node>;
using Operator    = Tpetra::Operator<Scalar, Local, Global, Node>;

inline Teuchos::RCP<const Teuchos::Comm<int>> communicator(MPI_Comm comm)
{
  return Teuchos::rcp(new Teuchos::MpiComm<int>(comm));
}

} // namespace sherd::tpetra
