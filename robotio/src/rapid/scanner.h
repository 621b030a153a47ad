// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string_view>

#include "rapid/names.h"

namespace bw::robotio {

enum class TokenKind { name, number, text, symbol, end, fault };

struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text;  ///< the characters; of a string, without quotes
  double number = 0;
  int line = 1;
};

/// Cuts the text into tokens, one at a time. Comments (`!` to the end of the line) and white space vanish.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  Token next() {
    skipBlank();
    Token token;
    token.line = line_;
    if (at_ >= text_.size()) return token;
    const std::size_t start = at_;
    const char c = text_[at_];
    const auto begins = [](char letter) { return isLetter(letter) || letter == '_'; };
    if (begins(c)) {
      while (at_ < text_.size() && (begins(text_[at_]) || isDigit(text_[at_]))) ++at_;
      token.kind = TokenKind::name;
      token.text = text_.substr(start, at_ - start);
    } else if (isDigit(c)) {
      scanNumber(token);
    } else if (c == '"') {
      scanText(token);
    } else if (c == ':' && at_ + 1 < text_.size() && text_[at_ + 1] == '=') {
      at_ += 2;
      token.kind = TokenKind::symbol;
      token.text = text_.substr(start, 2);
    } else {
      ++at_;
      token.text = text_.substr(start, 1);
      token.kind = std::string_view("[]{}(),;\\-+").find(c) != std::string_view::npos ? TokenKind::symbol
                                                                                      : TokenKind::fault;
    }
    return token;
  }

 private:
  void skipBlank() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') ++line_;
      if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        ++at_;
      } else if (c == '!') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else {
        return;
      }
    }
  }

  void scanNumber(Token& token) {
    const char* const begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), token.number);
    token.kind = error == std::errc{} ? TokenKind::number : TokenKind::fault;
    token.text = text_.substr(at_, std::size_t(end - begin));
    at_ += token.text.size();
  }

  void scanText(Token& token) {
    const std::size_t start = ++at_;
    while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
    token.text = text_.substr(start, at_ - start);
    token.kind = at_ < text_.size() && text_[at_] == '"' ? TokenKind::text : TokenKind::fault;
    if (token.kind == TokenKind::text) ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace bw::robotio
