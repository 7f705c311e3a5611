#include "src/problem/write_error.hpp"

#include <cerrno>
#include <cstring>

namespace lorentz {
namespace {

const char* remedy_of(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return "; free some, or write to another disk";
    case EFBIG:
      return "; raise the limit of the sizes of files (ulimit -f)";
    case ENOENT:
    case ENOTDIR:
      return "; make its folder first, or name another file";
    case ELOOP:
      return "; remove the link, or name another file";
    case EISDIR:
      return "; name a file in it";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; write where you may, or have it allowed";
    default:
      return "";
  }
}

}  // namespace

FileError write_error(const std::string& place, int error_number) {
  return FileError(place + ": " + std::strerror(error_number) + remedy_of(error_number));
}

}  // namespace lorentz
