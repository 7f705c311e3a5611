#include "golden/record.hpp"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/sha.h>

#include <stdexcept>

namespace lorentz::golden {
namespace {

void append_basis(std::string& out, const oracle::CertificateBasis& basis, int dimension) {
  out += ",\"basis\":[";
  for (int i = 0; i < dimension; ++i) {
    out += i == 0 ? "[" : ",[";
    for (int k = 0; k < dimension; ++k) {
      if (k > 0) out += ',';
      append_integer(out, basis[i][k]);
    }
    out += ']';
  }
  out += "]}";
}

// A number if a binary64 is exactly that, else a string.
void append_end(std::string& out, const oracle::WindowEnd& end) {
  if (const auto value = binary64_of(end))
    append_number(out, *value);
  else
    out += '"' + text_of(end) + '"';
}

void append_place(std::string& out, bool first, int lattice, int atom) {
  out += first ? "{" : ",{";
  out += "\"lattice\":" + std::to_string(lattice) + ",\"atom\":" + std::to_string(atom);
}

void append_certificate(std::string& out, const oracle::Certificate& certificate, int dimension) {
  out += ",\"certificate\":{";
  if (!certificate.rows.empty()) {
    out += "\"rows\":[";
    for (const oracle::Rows& rows : certificate.rows) {
      append_place(out, &rows == &certificate.rows.front(), rows.lattice, rows.atom);
      append_basis(out, rows.basis, dimension);
    }
    out += certificate.windows.empty() ? "]}" : "],";
    if (certificate.windows.empty()) return;
  }
  out += "\"windows\":[";
  for (const oracle::Window& window : certificate.windows) {
    append_place(out, &window == &certificate.windows.front(), window.lattice, window.atom);
    out += ",\"from\":";
    append_end(out, window.from);
    out += ",\"to\":";
    append_end(out, window.to);
    append_basis(out, window.basis, dimension);
  }
  out += "]}";
}

// The members of an answer, without its id and digits, as an object.
std::string expectation(Answer answer, int dimension) {
  answer.time_decimal.clear();
  std::string line;
  append_answer_line(line, "0", answer, dimension);  // {"id":0,"outcome":...}\n
  return '{' + line.substr(8, line.size() - 9);
}

void append_text(std::string& out, const char* key, const std::string& text) {
  out += ",\"" + std::string(key) + "\":" + json_quoted(text);
}

}  // namespace

std::string sha256(std::string_view text) {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  if (EVP_Digest(text.data(), text.size(), digest, nullptr, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 failed");
  std::string hexadecimal;
  for (const unsigned char byte : digest) {
    hexadecimal += "0123456789abcdef"[byte >> 4];
    hexadecimal += "0123456789abcdef"[byte & 15];
  }
  return hexadecimal;
}

std::string id_of(std::string_view scene_line, std::string_view question) {
  std::string text(scene_line);
  text += '\n';
  text += question;
  return sha256(text).substr(0, 16);
}

std::string question_of(const Query& query, int dimension) {
  std::string line;
  append_query_line(line, "0", query, dimension);  // {"id":0,"x":...}\n
  return line.substr(8, line.size() - 10);
}

void append_header_line(std::string& out, const Header& header) {
  out += "{\"golden\":{\"format\":1";
  append_text(out, "name", header.name);
  append_text(out, "description", header.description);
  append_text(out, "generator", header.generator);
  append_text(out, "version", header.version);
  out += ",\"count\":" + std::to_string(header.count) + ",\"tags\":{";
  for (const auto& [tag, note] : header.tags) {
    if (&tag != &header.tags.front().first) out += ',';
    out += json_quoted(tag) + ':' + json_quoted(note);
  }
  out += "}}}\n";
}

void append_record_line(std::string& out, const Record& record, int dimension) {
  out += "{\"id\":" + json_quoted(record.id) + ",\"tags\":[";
  for (const std::string& tag : record.tags) {
    if (&tag != &record.tags.front()) out += ',';
    out += json_quoted(tag);
  }
  out += "]," + record.question + ",\"expect\":" + expectation(record.expect, dimension);
  if (!record.expect.time_decimal.empty()) append_text(out, "time_decimal", record.expect.time_decimal);
  if (record.margin) {
    out += ",\"margin\":";
    append_number(out, *record.margin);
  }
  if (record.condition) {
    out += ",\"condition\":";
    append_number(out, *record.condition);
  }
  if (record.certificate) append_certificate(out, *record.certificate, dimension);
  out += "}\n";
}

std::string record_libraries() {
  return std::string("OpenSSL ") + OpenSSL_version(OPENSSL_VERSION_STRING);
}

}  // namespace lorentz::golden
