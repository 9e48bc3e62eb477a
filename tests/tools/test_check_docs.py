#!/usr/bin/env python3
"""Tests of tools/check_docs.py: each rule of comments and sentences accepts a good text and rejects a bad one."""
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "tools"))
import check_docs


def found(*lines, name="a.cpp"):
    return list(check_docs.commentComplaints([(name, "\n".join(lines) + "\n")]))


def comments(*lines, name="a.cpp"):
    return [comment for _, comment in check_docs.commentsOf(name, "\n".join(lines))]


def expect(condition, message):
    if not condition:
        sys.exit(f"failed: {message}")


def testFirstWordsOfComments():
    good = ["// Sorts the links by colour."] * 98
    for word in ("Of", "What", "Who", "Whoever", "Where", "Which", "Likewise"):
        bad = f"// {word} a body."
        expect(not found(*good, bad, bad), f"2 % of comments may begin with {word}")
        expect(len(found(*good[1:], bad, bad, bad)) == 1, f"3 % of comments may not begin with {word}")
    expect(not found("// Offsets of the links.", "// Whatever."), "longer words are no first words")
    expect(found("int a; ///< Of a body.") and found("    //! What it is."), "every kind of comment counts")
    expect(found("# Which tests run.", name="a.sh"), "comments of scripts count")


def testComments():
    expect(comments("int a; // one", "/// two", "/* three */", 'char b = \'"\'; // four') == ["one", "two", "four"], "comments")
    expect(comments('log("// Of a body");', "const int n = 10'000; // five") == ["five"], "strings are no comments")
    expect(comments("#!/bin/sh", "a=1 # two", "  # three", name="a.sh") == ["three"], "comments of scripts")


def testCitations():
    for text in ("(methods: D)", "(contacts: 3)", "(cases: 1; methods: C)", "(lattice: a cube)", "(skin: 2.1, last)"):
        expect(len(found(f"// A stable step {text}.")) == 1, f"{text} cites a document that is not here")
    for text in ("(default: off)", "XPBD [Macklin 2016], eq. 18", "(docs/contacts.md)", "(see: Simulation::record)"):
        expect(not found(f"// A stable step {text}."), f"{text} is allowed")
    expect(not found('log("(methods: D)");'), "a text of the program is no comment")
    expect(len(found("// The rules are in docs/nowhere.md.")) == 1, "a page that does not exist")
    expect(not found("// The rules are in docs/glossary.md."), "a page that exists")


def testSentences():
    def found(text):
        return list(check_docs.sentenceComplaints("docs/page.md", text))

    expect(len(found("# Cuts\nWhat a blade does.\n")) == 1, "a heading is no part of the sentence below it")
    expect(len(found("# What a blade does\nIt cuts.\n")) == 1, "a heading is a sentence of its own")
    expect(len(found("| a blade | Likewise it cuts |\n")) == 1, "a row of a table has sentences")
    expect(not found("# Cuts\nA blade cuts.\n"), "a good sentence")
    expect(len(found("See [here](nowhere.md).\n")) == 1 and not found("See [here](glossary.md).\n"), "links")


def testSizes():
    def found(text, **options):
        return list(check_docs.sizeComplaints("docs/page.md", text, **options))

    wide = "a " * check_docs.MOST_COLUMNS
    expect(len(found(wide + "\n")) == 1 and not found("A blade cuts.\n"), "a wide line")
    expect(not found(f"```\n{wide}\n```\n"), "code may be wide")
    expect(len(found(f"| {wide} |\n")) == 1, "a wide row of a page that explains")
    expect(not found(f"| {wide} |\n", hasWideTables=True), "a wide row of a page of figures")
    expect(len(found(wide + "\n", hasWideTables=True)) == 1, "wide text of a page of figures")
    expect(len(found("a\n" * 3, mostLines=2)) == 1 and not found("a\n" * 2, mostLines=2), "a long page")
    expect("docs/performance.md" in check_docs.FIGURES and len(check_docs.FIGURES) > 10, "the records are pages of figures")


for test in (testFirstWordsOfComments, testComments, testCitations, testSentences, testSizes):
    test()
print("check_docs: each rule can fail")
