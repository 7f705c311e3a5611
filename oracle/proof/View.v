(* docs/certificates.md, "What is claimed": "For an ellipsoid { p + A y : |y| < 1 }, first apply A^-1 to
   everything (c, x, v, the lattice). So it becomes a ball of radius 1; lines stay lines and t stays t." Here
   adj A = det A A^-1 is applied, which consists of integers. So the radius is det A. *)
From Coq Require Import ZArith Reals Lra Lia Psatz.
From Lorentz Require Import Vectors Search Space.
Local Open Scope R_scope.

Record matrix := Matrix { m1 : zv; m2 : zv; m3 : zv; radius : Z }.
Definition adjugate (b : body) : matrix :=
  match b with
  | Ball r => Matrix (V 1 0 0) (V 0 1 0) (V 0 0 1) r
  | Ellipsoid a1 a2 a3 => Matrix (cross a2 a3) (cross a3 a1) (cross a1 a2) (det a1 a2 a3)
  end.
Definition apply_to (M : matrix) (w : zv) : zv := V (dot (m1 M) w) (dot (m2 M) w) (dot (m3 M) w).

Definition rdot (a b : rv) := px a * px b + py a * py b + pz a * pz b.
Definition rapply (M : matrix) (q : rv) : rv := P (rdot (real (m1 M)) q) (rdot (real (m2 M)) q)
  (rdot (real (m3 M)) q).

Lemma ball_view r c q : in_body (Ball r) c q <-> norm2 (rapply (adjugate (Ball r)) (radd q (-1) c)) < IZR r *
  IZR r.
Proof.
  cbn [in_body]. replace (norm2 (rapply _ _)) with (norm2 (radd q (-1) c)); [tauto|].
  unfold norm2, rapply, rdot, radd; cbn. ring.
Qed.

(* A y = q iff y = adj A q / det A. *)
Lemma ellipsoid_view a1 a2 a3 c q : det a1 a2 a3 <> 0%Z ->
  in_body (Ellipsoid a1 a2 a3) c q <->
  norm2 (rapply (adjugate (Ellipsoid a1 a2 a3)) (radd q (-1) c)) < IZR (det a1 a2 a3) * IZR (det a1 a2 a3).
Proof.
  intros Hr. apply not_0_IZR in Hr. destruct a1 as [a b e], a2 as [d f g], a3 as [h i j], c as [c1 c2 c3],
    q as [q1 q2 q3].
  unfold in_body, adjugate, rapply, rdot, norm2, rplace, radd, det, dot, cross, real in *; cbn in *.
  repeat rewrite ?plus_IZR, ?minus_IZR, ?mult_IZR in *.
  generalize dependent (IZR a); intros A; generalize dependent (IZR b); intros B;
    generalize dependent (IZR e); intros C;
  generalize dependent (IZR d); intros D; generalize dependent (IZR f); intros E;
    generalize dependent (IZR g); intros F;
  generalize dependent (IZR h); intros G; generalize dependent (IZR i); intros H;
    generalize dependent (IZR j); intros I Hr.
  set (dd := A * (E * I - F * H) + B * (F * G - D * I) + C * (D * H - E * G)) in *.
  set (p1 := q1 + -1 * c1). set (p2 := q2 + -1 * c2). set (p3 := q3 + -1 * c3).
  set (M1 := (E * I - F * H) * p1 + (F * G - D * I) * p2 + (D * H - E * G) * p3).
  set (M2 := (H * C - I * B) * p1 + (I * A - G * C) * p2 + (G * B - H * A) * p3).
  set (M3 := (B * F - C * E) * p1 + (C * D - A * F) * p2 + (A * E - B * D) * p3).
  assert (Hd : 0 < dd * dd) by nra.
  split.
  - intros ([y1 y2 y3] & Hy & Eq). cbn in *. injection Eq as E1 E2 E3.
    replace (M1 * M1 + M2 * M2 + M3 * M3) with (dd * dd * (y1 * y1 + y2 * y2 + y3 * y3))
      by (subst M1 M2 M3 p1 p2 p3 dd; rewrite E1, E2, E3; ring).
    rewrite <- (Rmult_1_r (dd * dd)) at 2. apply Rmult_lt_compat_l; auto.
  - intros K. exists (P (M1 / dd) (M2 / dd) (M3 / dd)). cbn. split.
    + replace (M1 / dd * (M1 / dd) + M2 / dd * (M2 / dd) + M3 / dd * (M3 / dd))
        with ((M1 * M1 + M2 * M2 + M3 * M3) / (dd * dd)) by (field; auto).
      apply Rmult_lt_reg_r with (dd * dd); auto. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
    + assert (S : forall c u1 u2 u3, c + M1 / dd * u1 + M2 / dd * u2 + M3 / dd * u3 = c +
        (M1 * u1 + M2 * u2 + M3 * u3) / dd)
        by (intros; field; auto).
      assert (T : forall q c z, z = dd * (q + -1 * c) -> q = c + z / dd) by (intros; subst; field; auto).
      rewrite !S. apply rv_eq; cbn; apply T; subst M1 M2 M3 p1 p2 p3 dd; clear; ring.
Qed.

Lemma body_view b c q : radius (adjugate b) <> 0%Z ->
  in_body b c q <-> norm2 (rapply (adjugate b) (radd q (-1) c)) < IZR (radius (adjugate b)) *
    IZR (radius (adjugate b)).
Proof. destruct b; intros H; [apply ball_view|apply ellipsoid_view, H]. Qed.

(* ---- An atom as the ray sees it: as balls. *)
Record seen := Seen { sk : nat; sv : zv; sw : zv; s1 : zv; s2 : zv; s3 : zv; sr : Z (* r^2 v^2 *) }.
Definition see (x v : zv) (S : solid) : seen :=
  let M := adjugate (shaped S) in let v' := apply_to M v in
  Seen (rank S) v' (apply_to M (add (middle S) (-1) x)) (apply_to M (g1 S)) (apply_to M (g2 S)) (apply_to M (g3 S))
    (radius M * radius M * dot v' v').
Definition at_cell (y : seen) (n : zv) : zv := place (sw y) n (s1 y) (s2 y) (s3 y).
Definition sQ (y : seen) : Z := dot (sv y) (sv y).
Definition sS (y : seen) (w : zv) : Z := dot (sv y) w.
Definition sD (y : seen) (w : zv) : Z := (sr y - h2 (sv y) w)%Z.

Lemma rapply_line M x v S n t : rapply M (radd (radd (real x) t (real v)) (-1) (middle_of S n)) =
  P (t * IZR (dot (m1 M) v) - IZR (dot (m1 M) (add (middle S) (-1) x) + vz n * dot (m1 M) (g3 S) + vy n *
    dot (m1 M) (g2 S) + vx n * dot (m1 M) (g1 S)))
    (t * IZR (dot (m2 M) v) - IZR (dot (m2 M) (add (middle S) (-1) x) + vz n * dot (m2 M) (g3 S) + vy n *
      dot (m2 M) (g2 S) + vx n * dot (m2 M) (g1 S)))
    (t * IZR (dot (m3 M) v) - IZR (dot (m3 M) (add (middle S) (-1) x) + vz n * dot (m3 M) (g3 S) + vy n *
      dot (m3 M) (g2 S) + vx n * dot (m3 M) (g1 S))).
Proof.
  unfold rapply. generalize (m1 M), (m2 M), (m3 M). intros k1 k2 k3.
  assert (Q : forall k, rdot (real k) (radd (radd (real x) t (real v)) (-1) (middle_of S n)) =
    t * IZR (dot k v) - IZR (dot k (add (middle S) (-1) x) + vz n * dot k (g3 S) + vy n * dot k (g2 S) +
      vx n * dot k (g1 S))).
  { intros. unfold middle_of, rplace, add, dot, rdot, radd, real; cbn [vx vy vz px py pz].
    repeat rewrite ?plus_IZR, ?mult_IZR. ring. }
  rewrite !Q. reflexivity.
Qed.

Theorem chord_view x v S n t : radius (adjugate (shaped S)) <> 0%Z -> let y := see x v S in (0 < sQ y)%Z ->
  let w := at_cell y n in
  in_body (shaped S) (middle_of S n) (radd (real x) t (real v)) <->
  (IZR (sQ y) * t - IZR (sS y w)) * (IZR (sQ y) * t - IZR (sS y w)) < IZR (sD y w).
Proof.
  intros Hr y Hq w. rewrite body_view by auto. rewrite rapply_line. set (M := adjugate (shaped S)) in *.
  assert (HR : sr y = (radius M * radius M * sQ y)%Z) by reflexivity.
  assert (Ew : vx w = (dot (m1 M) (add (middle S) (-1) x) + vz n * dot (m1 M) (g3 S) + vy n *
    dot (m1 M) (g2 S) + vx n * dot (m1 M) (g1 S))%Z
    /\ vy w = (dot (m2 M) (add (middle S) (-1) x) + vz n * dot (m2 M) (g3 S) + vy n * dot (m2 M) (g2 S) +
      vx n * dot (m2 M) (g1 S))%Z
    /\ vz w = (dot (m3 M) (add (middle S) (-1) x) + vz n * dot (m3 M) (g3 S) + vy n * dot (m3 M) (g2 S) +
      vx n * dot (m3 M) (g1 S))%Z)
    by (repeat split; reflexivity).
  destruct Ew as (<- & <- & <-).
  assert (Ev : sv y = V (dot (m1 M) v) (dot (m2 M) v) (dot (m3 M) v)) by reflexivity.
  unfold sD, h2. fold (sQ y). fold (sS y w). rewrite HR. clear HR.
  assert (E : norm2 (P (t * IZR (dot (m1 M) v) - IZR (vx w)) (t * IZR (dot (m2 M) v) - IZR (vy w)) (t *
    IZR (dot (m3 M) v) - IZR (vz w)))
    = t * t * IZR (sQ y) - 2 * t * IZR (sS y w) + IZR (dot w w)).
  { unfold sQ, sS. rewrite Ev. generalize w. clear. intros w. unfold norm2, dot; cbn [vx vy vz px py pz].
    repeat rewrite ?plus_IZR, ?mult_IZR. ring. }
  rewrite E. clear E Ev. rewrite !minus_IZR, !mult_IZR. apply IZR_lt in Hq. set (qq := IZR (sQ y)) in *.
  set (ss := IZR (sS y w)).
  set (W := IZR (dot w w)). set (rr := IZR (radius M)). split; intros K; nra.
Qed.

Lemma sr_nonneg x v S : (0 <= sr (see x v S))%Z.
Proof. unfold see, sr. apply Z.mul_nonneg_nonneg; [apply Z.square_nonneg|apply square]. Qed.
