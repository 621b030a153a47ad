// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Random and nasty texts typed with key events into every field of the real window: what is taken is what was
// meant, what is not taken stays as it was typed, and nothing is lost on the way.
#include <QApplication>
#include <QLocale>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "bw/core/text/typed_number.h"
#include "every_field.h"

namespace bw::app {
namespace {

/// A text and what it means to a person.
struct Meant {
  QString text;
  double value = 0;
};

/// Writes numbers as people do, and knows what they are.
class Writer {
 public:
  explicit Writer(unsigned seed) : random_(seed) {}

  int below(int n) { return int(random_() % unsigned(n)); }

  /// A number in one of the ways to write it.
  Meant number() {
    const int decimals = below(5);
    const double scale = std::pow(10.0, decimals);
    const double value = double(below(below(2) ? 100000 : 2000000)) / scale;
    QString text = QString::number(value, 'f', decimals);
    if (below(6) == 0)
      return {QString::number(value, 'e', 6).replace('.', below(2) ? ',' : '.'), rounded(value)};
    const bool comma = below(2);
    const qsizetype point = text.indexOf('.');
    const qsizetype digits = point < 0 ? text.size() : point;
    if (below(3) == 0 && digits > 3) {
      const QString kGroups[] = {" ", "'", QString(QChar(0xa0)), comma ? "." : ","};
      const QString& group = kGroups[below(4)];
      // One group alone needs its decimals, or a sign that is not one of theirs.
      if (point >= 0 || group == " ")
        for (qsizetype at = digits - 3; at > 0; at -= 3) text.insert(at, group);
      const qsizetype last = point < 0 ? -1 : text.lastIndexOf('.');
      if (comma && last >= 0) text[last] = ',';
      return {text, value};
    }
    if (comma) text.replace('.', ',');
    return {text, value};
  }

  /// A number or a short sum, product or quotient.
  Meant expression() {
    const Meant a = number(), b = number();
    switch (below(9)) {
      case 0:
        return {a.text + "+" + b.text, a.value + b.value};
      case 1:
        return {a.text + " - " + b.text, a.value - b.value};
      case 2:
        return {a.text + "*3", 3 * a.value};
      case 3:
        return {a.text + "/4", a.value / 4};
      case 4:
        return {"2*" + a.text + "+" + b.text, 2 * a.value + b.value};
      case 5:
        return {"(" + a.text + "+" + b.text + ")/2", (a.value + b.value) / 2};
      case 6:
        return {"-" + a.text, -a.value};
      default:
        return a;
    }
  }

  /// An expression in a unit of the field.
  Meant quantity(const QString& unit) {
    struct Unit {
      const char* name;
      double factor;
    };
    Meant meant = expression();
    const bool sum = meant.text.contains('+') || meant.text.contains(" - ");
    if (below(3) > 0 || sum) return meant;
    static const Unit kLengths[] = {{"mm", 1}, {" cm", 10}, {"m", 1000}, {" in", 25.4}, {" CM", 10}};
    static const Unit kSpeeds[] = {{"mm/s", 1}, {" cm/s", 10}, {" m/min", 1000.0 / 60}};
    Unit chosen{"", 1};
    if (unit == "mm") chosen = kLengths[below(5)];
    if (unit == "mm/s") chosen = kSpeeds[below(3)];
    return {meant.text + chosen.name, meant.value * chosen.factor};
  }

  /// The text with a few letters of it changed into nasty ones.
  QString spoiled(QString text) {
    static const QString kNasty = QStringLiteral(
        "0123456789.,,..  "
        "--++e/*()x'\"mcinrad%#=_^~\\$\u00b0\u00d7\u2212\u0665\u20ac\u00bd\u00b2\u200b\u202f\u4e00");
    for (int i = below(4) + 1; i > 0; --i) {
      const QChar c = kNasty[below(int(kNasty.size()))];
      const int at = below(int(text.size()) + 1);
      if (below(3) == 0 && at < text.size())
        text.remove(at, 1);
      else if (below(2) && at < text.size())
        text[at] = c;
      else
        text.insert(at, c);
    }
    return text;
  }

 private:
  /// As it is with six decimals of the exponent form.
  static double rounded(double value) { return QString::number(value, 'e', 6).toDouble(); }

  std::mt19937 random_;
};

class HostileTyping : public EveryFieldTest {
 protected:
  void typeNumbers(NumberField& field, int rounds) {
    const NumberRange& range = field.range();
    for (int i = 0; i < rounds; ++i) {
      const Meant meant = writer_.quantity(range.unit);
      const bool whole = writer_.below(2) || meant.text.isEmpty();
      const QString text = whole ? meant.text : writer_.spoiled(meant.text);
      const double before = field.value();
      const int changes = bench().document().undoStack().index();
      typeOver(field, text);
      ASSERT_EQ(field.text(), text) << "letters were dropped while typing";
      QTest::keyClick(&field, Qt::Key_Return);
      ++texts_;
      if (field.refused()) {
        ++refused_;
        EXPECT_EQ(field.text(), text);
        EXPECT_EQ(field.value(), before);
        EXPECT_EQ(bench().document().undoStack().index(), changes) << text.toStdString();
        const bool inside = meant.value >= range.min && meant.value <= range.max &&
                            (range.decimals > 0 || meant.value == std::round(meant.value));
        if (whole && inside) ++cautious_;
        QTest::keyClick(&field, Qt::Key_Escape);
        EXPECT_FALSE(field.typing());
        EXPECT_EQ(field.value(), before);
        continue;
      }
      ++taken_;
      const double value = field.value();
      EXPECT_TRUE(std::isfinite(value) && value >= range.min && value <= range.max) << text.toStdString();
      if (whole && std::abs(value - meant.value) > 1e-9 * std::max(1.0, std::abs(meant.value))) {
        ++wrong_;
        ADD_FAILURE() << text.toStdString() << " means " << meant.value << " but became " << value;
      }
      // Whatever it was, the field says what it holds.
      const NumberDemand demand{range.unit.toStdString(), range.min, range.max, range.decimals == 0};
      const Result<double> shown = readTypedNumber(field.text().toStdString(), demand);
      if (!field.text().isEmpty()) {
        EXPECT_TRUE(shown && std::abs(*shown - value) <= 1e-5 * std::max(1e-3, std::abs(value)))
            << text.toStdString() << " shows as " << field.text().toStdString() << " but is " << value;
      }
    }
  }

  void typeLists(ListField& field, int rounds) {
    for (int i = 0; i < rounds; ++i) {
      field.setCount(20);
      QString text;
      std::vector<int> meant;
      for (int k = writer_.below(4) + 1; k > 0; --k) {
        const int a = writer_.below(20), b = a + writer_.below(5);
        static const char* const kBetween[] = {", ", ",", " ", ";"};
        if (!text.isEmpty()) text += kBetween[writer_.below(4)];
        text += b > a ? QString("%1-%2").arg(a).arg(b) : QString::number(a);
        for (int n = a; n <= b; ++n)
          if (std::find(meant.begin(), meant.end(), n) == meant.end()) meant.push_back(n);
      }
      const bool whole = writer_.below(2);
      if (!whole) text = writer_.spoiled(text);
      const std::vector<int> before = field.numbers();
      typeOver(field, text);
      ASSERT_EQ(field.text(), text);
      QTest::keyClick(&field, Qt::Key_Return);
      ++texts_;
      if (field.refused()) {
        ++refused_;
        EXPECT_EQ(field.text(), text);
        EXPECT_EQ(field.numbers(), before);
        EXPECT_TRUE(!whole || meant.back() >= 20 || *std::max_element(meant.begin(), meant.end()) >= 20)
            << text.toStdString();
        QTest::keyClick(&field, Qt::Key_Escape);
      } else {
        ++taken_;
        if (whole && field.numbers() != meant) {
          ++wrong_;
          ADD_FAILURE() << text.toStdString() << " became " << field.text().toStdString();
        }
      }
    }
  }

  Writer writer_{20261122};
  int fields_ = 0, texts_ = 0, taken_ = 0, refused_ = 0, cautious_ = 0, wrong_ = 0;
};

TEST_F(HostileTyping, NeverPutsAWrongNumberIntoAField) {
  const char* factor = std::getenv("BW_HOSTILE");
  const int rounds = int(12 * std::max(1.0, factor ? std::atof(factor) : 1.0));
  static const char* const kLocales[] = {"C", "de_DE", "tr_TR"};
  visitFields([&](TypedField& typed) {
    QLocale::setDefault(QLocale(kLocales[fields_++ % 3]));
    if (auto* number = qobject_cast<NumberField*>(&typed))
      typeNumbers(*number, rounds);
    else if (auto* list = qobject_cast<ListField*>(&typed))
      typeLists(*list, rounds);
  });
  QLocale::setDefault(QLocale::c());
  std::printf(
      "hostile typed_numbers: %d fields, %d texts, %d taken, %d refused in words (%d of a number that is "
      "within the limits), %d wrong\n",
      fields_, texts_, taken_, refused_, cautious_, wrong_);
  EXPECT_GT(taken_, texts_ / 10) << "all is refused";
  EXPECT_EQ(wrong_, 0);
}

}  // namespace
}  // namespace bw::app
