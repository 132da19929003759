// GJK and EPA to read as a lesson, in 1D, 2D and 3D, and the few lines that put your own under gjkdbg:
//
//   javac Gjk.java && gjkdbg run SCENE --exec "java Gjk"
//
// Replace what `main` calls by yours. All it needs is support(d): the farthest point w of A - B along d, with a and b, w = a - b. Reports by `say`
// ("simplex", "polytope", "face") are optional; the more you report, the earlier gjkdbg can tell where it went wrong.
import java.io.*;
import java.math.*;
import java.util.*;
import java.util.function.*;
import java.util.stream.*;

public class Gjk {
  // --- The protocol: one JSON message a line ----------------------------------------------------------------------
  record Vertex(int number, double[] w, double[] a, double[] b) {}

  static final BufferedReader in = new BufferedReader(new InputStreamReader(System.in));

  static void say(String line) { System.out.println(line); System.out.flush(); }
  static String read() throws IOException { return in.readLine(); }
  static String text(double[] v) { return Arrays.toString(v); }
  static String numbers(List<Vertex> list) { return list.stream().map(x -> "" + x.number).collect(Collectors.joining(",", "[", "]")); }
  /** The text after a field's colon; the lines come from gjkdbg, without spaces. */
  static String value(String line, String key) { return line.substring(line.indexOf("\"" + key + "\":") + key.length() + 3); }
  static double number(String line, String key) { return Double.parseDouble(value(line, key).split("[,}]")[0]); }
  static double[] vector(String line, String key) {
    String list = value(line, key);
    return Arrays.stream(list.substring(1, list.indexOf(']')).split(",")).mapToDouble(Double::parseDouble).toArray();
  }
  static Vertex support(double[] d) throws IOException {
    say("{\"type\":\"support\",\"direction\":" + text(d) + "}");
    String line = read().replace("\"type\":\"vertex\",", "");
    return new Vertex((int) number(line, "vertex"), vector(line, "w"), vector(line, "a"), vector(line, "b"));
  }

  // --- Vectors --------------------------------------------------------------------------------------------------------
  static double dot(double[] x, double[] y) { double s = 0; for (int i = 0; i < x.length; ++i) s += x[i] * y[i]; return s; }
  static double[] plus(double[] x, double s, double[] y) { double[] r = x.clone(); for (int i = 0; i < r.length; ++i) r[i] += s * y[i]; return r; }
  static double[] minus(double[] x, double[] y) { return plus(x, -1, y); }
  static double[] scaled(double s, double[] x) { return plus(new double[x.length], s, x); }
  static double length(double[] x) { return Math.sqrt(dot(x, x)); }
  static double[] unit(int n, int k) { double[] r = new double[n]; r[k] = 1; return r; }

  /** All ways to pick `size` of a list. */
  static List<List<Vertex>> combinations(List<Vertex> list, int size) {
    if (size == 0) return List.of(List.of());
    List<List<Vertex>> out = new ArrayList<>();
    for (int i = 0; i < list.size(); ++i)
      for (List<Vertex> rest : combinations(list.subList(i + 1, list.size()), size - 1)) {
        List<Vertex> one = new ArrayList<>(List.of(list.get(i)));
        one.addAll(rest);
        out.add(one);
      }
    return out;
  }

  // --- GJK: the nearest part of a simplex ------------------------------------------------------------------------------
  record Nearest(List<Vertex> part, double[] v, double[] weights) {
    double[] at(Function<Vertex, double[]> which) {
      double[] sum = new double[v.length];
      for (int i = 0; i < part.size(); ++i) sum = plus(sum, weights[i], which.apply(part.get(i)));
      return sum;
    }
  }
  /** Weights of the point nearest the origin in the flat through the points, or null when they do not span it.
   *  With p0 + sum t_i e_i, e_i = p_i - p0, the nearest has e_j . (p0 + sum t_i e_i) = 0 for all j: solved by elimination. p0 is the point that is
   *  nearest to the others: of a sliver's two long sides the products would lose what sets them apart. */
  static double[] affineWeights(List<Vertex> p) {
    int n = p.size() - 1;
    ToDoubleFunction<Vertex> spread = x -> p.stream().mapToDouble(y -> dot(minus(y.w, x.w), minus(y.w, x.w))).sum();
    int base = p.indexOf(p.stream().min(Comparator.comparingDouble(spread)).get());
    double[][] e = new double[n][], rows = new double[n][n + 1];
    for (int i = 0; i < n; ++i) e[i] = minus(p.get(i < base ? i : i + 1).w, p.get(base).w);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) rows[i][j] = dot(e[i], e[j]);
      rows[i][n] = -dot(e[i], p.get(base).w);
    }
    for (int c = 0; c < n; ++c) {
      for (int r = c + 1; r < n; ++r)
        if (Math.abs(rows[r][c]) > Math.abs(rows[c][c])) { double[] t = rows[r]; rows[r] = rows[c]; rows[c] = t; }
      if (Math.abs(rows[c][c]) <= 1e-14 * dot(e[c], e[c])) return null;
      for (int r = 0; r < n; ++r) if (r != c) rows[r] = plus(rows[r], -rows[r][c] / rows[c][c], rows[c]);
    }
    double[] weights = unit(n + 1, base);
    for (int i = 0; i < n; ++i) { double t = rows[i][n] / rows[i][i]; weights[i < base ? i : i + 1] = t; weights[base] -= t; }
    return weights;
  }
  /** The part of the simplex nearest the origin. Tries every part; slow, and never wrong. */
  static Nearest nearest(List<Vertex> simplex) {
    Nearest best = null;
    for (int size = 1; size <= simplex.size(); ++size)
      for (List<Vertex> part : combinations(simplex, size)) {
        double[] weights = affineWeights(part);
        if (weights == null || Arrays.stream(weights).min().getAsDouble() < 0) continue;
        double[] v = new Nearest(part, part.get(0).w, weights).at(Vertex::w);
        if (best == null || dot(v, v) < dot(best.v, best.v)) best = new Nearest(part, v, weights);
      }
    return best;
  }
  /** |v| is the distance; v = 0 when they overlap. */
  static Nearest gjk(int dimension, double tolerance) throws IOException {
    Nearest now = nearest(List.of(support(unit(dimension, 0))));
    for (double scale = length(now.v);;) {
      say("{\"type\":\"simplex\",\"vertices\":" + numbers(now.part) + ",\"closest\":" + text(now.v) + "}");
      if (length(now.v) <= 1e-12 * scale || now.part.size() == dimension + 1) return new Nearest(now.part, new double[dimension], now.weights);
      Vertex w = support(scaled(-1, now.v));
      scale = Math.max(scale, length(w.w));
      boolean known = now.part.stream().anyMatch(x -> Arrays.equals(x.w, w.w));
      if (dot(now.v, now.v) - dot(now.v, w.w) <= tolerance * dot(now.v, now.v) || known) return now;
      List<Vertex> simplex = new ArrayList<>(List.of(w));
      simplex.addAll(now.part);
      Nearest next = nearest(simplex);
      if (dot(next.v, next.v) >= dot(now.v, now.v)) return now; // rounding: no nearer part can be told
      now = next;
    }
  }

  // --- EPA ----------------------------------------------------------------------------------------------------------------
  /** A face with its unit normal away from a point inside, its distance from the origin, and the normal of any length without rounding. */
  record Face(List<Vertex> corners, double[] normal, double distance, BigDecimal[] exactNormal) {}
  record Depth(double depth, double[] normal, Nearest foot) {}

  // Without rounding.
  static BigDecimal[] exact(double[] x) { return Arrays.stream(x).mapToObj(BigDecimal::new).toArray(BigDecimal[]::new); }
  static BigDecimal[] minus(BigDecimal[] x, BigDecimal[] y) { return IntStream.range(0, x.length).mapToObj(i -> x[i].subtract(y[i])).toArray(BigDecimal[]::new); }
  static BigDecimal dot(BigDecimal[] x, BigDecimal[] y) { return IntStream.range(0, x.length).mapToObj(i -> x[i].multiply(y[i])).reduce(BigDecimal.ZERO, BigDecimal::add); }
  static BigDecimal cross(BigDecimal[] x, BigDecimal[] y, int i, int j) { return x[i].multiply(y[j]).subtract(x[j].multiply(y[i])); }

  /** Of the slivers that thin shapes lead to a normal from rounded differences may be any. */
  static Face face(List<Vertex> c, double[] inside) {
    BigDecimal[] p = exact(c.get(0).w), n = {BigDecimal.ONE};
    if (c.size() == 2) { BigDecimal[] x = minus(exact(c.get(1).w), p); n = new BigDecimal[] {x[1], x[0].negate()}; }
    if (c.size() == 3) {
      BigDecimal[] x = minus(exact(c.get(1).w), p), y = minus(exact(c.get(2).w), p);
      n = new BigDecimal[] {cross(x, y, 1, 2), cross(x, y, 2, 0), cross(x, y, 0, 1)};
    }
    if (dot(n, minus(p, exact(inside))).signum() < 0) n = Arrays.stream(n).map(BigDecimal::negate).toArray(BigDecimal[]::new);
    BigDecimal largest = Arrays.stream(n).map(BigDecimal::abs).max(Comparator.naturalOrder()).get();
    double[] unit = Arrays.stream(n).mapToDouble(x -> x.divide(largest, new MathContext(20)).doubleValue()).toArray();
    unit = scaled(1 / length(unit), unit);
    return new Face(c, unit, dot(unit, c.get(0).w), n);
  }
  /** Whether w lies on an edge's line, but for 1e-14 of the lengths: with |x|^2 |y|^2 - (x . y)^2 the square of the triangle's area, twice. */
  static boolean inLine(Vertex w, List<Vertex> edge) {
    BigDecimal[] x = minus(exact(w.w), exact(edge.get(0).w)), y = minus(exact(w.w), exact(edge.get(1).w));
    BigDecimal xx = dot(x, x), yy = dot(y, y), xy = dot(x, y), longest = xx.max(yy);
    return xx.multiply(yy).subtract(xy.multiply(xy)).compareTo(longest.multiply(longest).scaleByPowerOfTen(-28)) <= 0;
  }
  /** Whether w lies beyond the face, or in its plane: told without rounding where that might decide. So the faces seen are always one disc with one
   *  rim, and no new face is without area: w on the line of an edge takes away the faces on both sides of it. */
  static boolean sees(Vertex w, Face f, double rounding) {
    double height = dot(f.normal, w.w) - f.distance;
    if (Math.abs(height) > rounding) return height > 0;
    if (dot(f.exactNormal, minus(exact(w.w), exact(f.corners.get(0).w))).signum() >= 0) return true;
    return f.corners.size() == 3 && combinations(f.corners, 2).stream().anyMatch(edge -> inLine(w, edge));
  }
  static double[] across(List<double[]> basis, double[] x) { for (double[] e : basis) x = plus(x, -dot(e, x), e); return x; }

  /** Adds vertices to `points` until they span the space; the direction across when A - B is flat, else null. */
  static double[] complete(List<Vertex> points, List<Vertex> simplex, int dimension) throws IOException {
    List<double[]> basis = new ArrayList<>();
    points.add(simplex.get(0));
    ToDoubleFunction<Vertex> off = x -> length(across(basis, minus(x.w, points.get(0).w)));
    double scale = simplex.stream().mapToDouble(x -> length(x.w)).max().getAsDouble() + 1e-300;
    while (points.size() <= dimension) {
      double[] axis = null;
      double limit = 1e-7 * scale;
      List<Vertex> candidates = simplex.stream().filter(x -> off.applyAsDouble(x) > limit).toList();
      if (candidates.isEmpty()) {
        axis = IntStream.range(0, dimension).mapToObj(k -> across(basis, unit(dimension, k))).max(Comparator.comparingDouble(Gjk::length)).get();
        axis = scaled(1 / length(axis), axis);
        candidates = List.of(support(axis), support(scaled(-1, axis)));
      }
      Vertex best = candidates.stream().max(Comparator.comparingDouble(off)).get();
      scale = Math.max(scale, length(best.w));
      if (off.applyAsDouble(best) <= 1e-10 * scale) return axis;
      double[] y = across(basis, minus(best.w, points.get(0).w));
      points.add(best);
      basis.add(scaled(1 / length(y), y));
    }
    return null;
  }
  static Depth epa(List<Vertex> simplex, int dimension, double tolerance) throws IOException {
    List<Vertex> points = new ArrayList<>();
    double[] flat = complete(points, simplex, dimension), inside = new double[dimension];
    if (flat != null) return new Depth(0, flat, nearest(simplex));
    for (Vertex x : points) inside = plus(inside, 1.0 / points.size(), x.w);
    double[] middle = inside;
    // Of a point's height above a plane: its normal's numbers are right to the last bits.
    double rounding = 1e-14 * points.stream().mapToDouble(x -> length(x.w)).max().getAsDouble(), height;
    List<Face> faces = combinations(points, dimension).stream().map(c -> face(c, middle)).collect(Collectors.toList());
    Face f;
    while (true) {
      say("{\"type\":\"polytope\",\"faces\":[" + faces.stream().map(x -> numbers(x.corners)).collect(Collectors.joining(",")) + "]}");
      f = Collections.min(faces, Comparator.comparingDouble(Face::distance));
      say("{\"type\":\"face\",\"vertices\":" + numbers(f.corners) + ",\"normal\":" + text(f.normal) + ",\"distance\":" + f.distance + "}");
      Vertex w = support(f.normal);
      height = dot(f.normal, w.w);
      rounding = Math.max(rounding, 1e-14 * length(w.w));
      if (height - f.distance <= Math.max(tolerance * height, rounding) || faces.size() > 600) break;
      Map<Set<Integer>, List<Vertex>> horizon = new LinkedHashMap<>(); // what belongs to one removed face only
      List<Face> kept = new ArrayList<>();
      for (Face x : faces) {
        if (!sees(w, x, rounding)) { kept.add(x); continue; }
        for (List<Vertex> ridge : combinations(x.corners, dimension - 1)) {
          Set<Integer> key = ridge.stream().map(Vertex::number).collect(Collectors.toSet());
          if (horizon.remove(key) == null) horizon.put(key, new ArrayList<>(ridge));
        }
      }
      for (List<Vertex> ridge : horizon.values()) { ridge.add(w); kept.add(face(ridge, middle)); }
      faces = kept;
    }
    // The origin's projection on the plane, as a combination of the corners of the face that holds it.
    Face answer = f;
    double limit = f.distance + 1e-9 * height;
    Nearest foot = faces.stream().filter(x -> x.distance <= limit)
        .map(x -> nearest(x.corners.stream().map(y -> new Vertex(y.number, plus(y.w, -answer.distance, answer.normal), y.a, y.b)).toList()))
        .min(Comparator.comparingDouble(x -> length(x.v))).get();
    return new Depth(height, f.normal, foot);
  }

  public static void main(String[] arguments) throws IOException {
    String scene = read(), query = value(scene, "query").split("\"")[1];
    int dimension = (int) number(scene, "dimension");
    double tolerance = number(scene, "tolerance");
    Nearest found = gjk(dimension, Math.max(tolerance, 1e-12));
    double distance = length(found.v);
    String result = "{\"type\":\"result\",\"intersecting\":" + (distance == 0);
    if (!query.equals("intersect") && distance > 0) {
      result += ",\"signed_distance\":" + distance + ",\"normal\":" + text(scaled(-1 / distance, found.v)) + ",\"witness_a\":" + text(found.at(Vertex::a)) + ",\"witness_b\":" + text(found.at(Vertex::b));
    } else if (query.equals("distance")) {
      result += ",\"signed_distance\":0";
    } else if (!query.equals("intersect")) {
      Depth d = epa(found.part, dimension, Math.max(tolerance, 1e-6));
      double[] middle = scaled(0.5, plus(d.foot.at(Vertex::a), 1, d.foot.at(Vertex::b)));
      result += ",\"signed_distance\":" + -d.depth + ",\"normal\":" + text(d.normal) + ",\"witness_a\":" + text(plus(middle, d.depth / 2, d.normal)) + ",\"witness_b\":" + text(plus(middle, -d.depth / 2, d.normal));
    }
    say(result + "}");
  }
}
