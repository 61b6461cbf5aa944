"""Counts the operations of straight-line Python code by the rules of `codegen::cost`.

Additions and subtractions, multiplications, divisions, square roots, calls. Negations, absolute values, signs and what
is made of constants alone are free. A chain of factors and divisors takes one division. A whole power takes the fewest
multiplications that it can be made with; a half power is a root and a power.
"""

import ast
from collections import Counter
from fractions import Fraction

KINDS = ["add", "mul", "div", "sqrt", "call"]
WEIGHTS = {"add": 1, "mul": 1, "div": 8, "sqrt": 10, "call": 20}
FREE = {"abs", "fabs", "sign", "float", "float64", "asarray", "array", "copysign"}

# Fewest multiplications for a power: lengths of shortest addition chains.
CHAINS = {1: 0, 2: 1, 3: 2, 4: 2, 5: 3, 6: 3, 7: 4, 8: 3, 9: 4, 10: 4, 11: 5, 12: 4, 13: 5, 14: 5, 15: 5, 16: 4}


def weight(counts):
    return sum(WEIGHTS[kind] * counts[kind] for kind in KINDS)


def total(counts):
    return sum(counts[kind] for kind in KINDS)


def constant(node):
    """The value of an expression of constants alone, else None."""
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return Fraction(node.value)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        inner = constant(node.operand)
        return None if inner is None else -inner
    if isinstance(node, ast.Attribute) and node.attr in {"pi", "e"}:
        return Fraction(314159, 100000)
    if isinstance(node, ast.BinOp):
        left, right = constant(node.left), constant(node.right)
        if left is None or right is None:
            return None
        if isinstance(node.op, ast.Add):
            return left + right
        if isinstance(node.op, ast.Sub):
            return left - right
        if isinstance(node.op, ast.Mult):
            return left * right
        if isinstance(node.op, ast.Div):
            return left / right
        if isinstance(node.op, ast.Pow):
            return Fraction(float(left) ** float(right))
    if isinstance(node, ast.Call) and name_of(node) in FREE and len(node.args) == 1:
        inner = constant(node.args[0])
        return None if inner is None else inner
    if isinstance(node, ast.Call) and node.args and all(constant(argument) is not None for argument in node.args):
        return Fraction(17, 16)
    return None


def power(base, exponent, counts):
    """Counts a power's own operations; whether it stands in a denominator."""
    doubled = exponent * 2
    if doubled.denominator != 1:
        counts["call"] += 1
        return False
    whole, half = divmod(abs(doubled.numerator), 2)
    counts["sqrt"] += half
    if whole:
        counts["mul"] += CHAINS.get(whole, whole.bit_length() + bin(whole).count("1") - 2) + half
    return exponent < 0


class Count(ast.NodeVisitor):
    def __init__(self):
        self.counts = Counter({kind: 0 for kind in KINDS})

    def factors(self, node, inverted, over, under):
        """The factors and divisors of a chain of products and quotients."""
        if isinstance(node, ast.UnaryOp):
            self.factors(node.operand, inverted, over, under)
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult) and constant(node) is None:
            self.factors(node.left, inverted, over, under)
            self.factors(node.right, inverted, over, under)
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div) and constant(node) is None:
            self.factors(node.left, inverted, over, under)
            self.factors(node.right, not inverted, over, under)
        elif self.exponent(node) is not None and self.exponent(node) < 0:
            # The power itself is counted without its sign.
            self.visit(node.left if isinstance(node, ast.BinOp) else node.args[0])
            power(None, -self.exponent(node), self.counts)
            (over if inverted else under).append(None)
        else:
            value = constant(node)
            if value is None:
                self.visit(node)
                (under if inverted else over).append(None)
            else:
                # Constants go together, above the line.
                over.append(value)

    @staticmethod
    def exponent(node):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
            return constant(node.right)
        if isinstance(node, ast.Call) and name_of(node) in {"pow", "power"}:
            return constant(node.args[1])
        return None

    def product(self, node):
        over, under = [], []
        self.factors(node, False, over, under)
        constants = [value for value in over if value is not None]
        over = [None for value in over if value is None]
        factor = Fraction(1)
        for value in constants:
            factor *= value
        # A constant numerator of a quotient is no multiplication; ±1 never is one.
        terms = len(over) + (abs(factor) != 1)
        self.counts["mul"] += max(terms - 1, 0) + max(len(under) - 1, 0)
        self.counts["div"] += bool(under)

    def visit_BinOp(self, node):
        if constant(node) is not None:
            return
        if isinstance(node.op, (ast.Add, ast.Sub)):
            self.counts["add"] += 1
            self.visit(node.left)
            self.visit(node.right)
        elif isinstance(node.op, (ast.Mult, ast.Div)):
            self.product(node)
        elif isinstance(node.op, ast.Pow):
            self.raised(node, node.left, node.right)
        else:
            raise ValueError(f"operator {ast.dump(node.op)}")

    def raised(self, node, base, exponent):
        value = constant(exponent)
        if value is None:
            self.visit(base)
            self.visit(exponent)
            self.counts["call"] += 1
        elif value < 0 and (value * 2).denominator == 1:
            self.product(node)
        else:
            self.visit(base)
            power(base, value, self.counts)

    def visit_Call(self, node):
        if constant(node) is not None:
            return
        name = name_of(node)
        if name in {"pow", "power"}:
            self.raised(node, node.args[0], node.args[1])
            return
        for argument in node.args:
            self.visit(argument)
        if name in FREE:
            return
        self.counts["sqrt" if name == "sqrt" else "call"] += 1

    def visit_IfExp(self, node):
        # A sign: `0.0 if x == 0 else copysign(1, x)`.
        if isinstance(node.orelse, ast.Call) and name_of(node.orelse) == "copysign":
            self.visit(node.orelse)
        else:
            raise ValueError("a condition")


def name_of(call):
    return call.func.attr if isinstance(call.func, ast.Attribute) else call.func.id


def count(code):
    """The counts of all statements of the code."""
    counter = Count()
    counter.visit(ast.parse(code))
    return counter.counts
