(* docs/certificates.md, "hit and inside: windows", 1. to 3., of one atom; and the window of "never: rows
   along v". *)
From Coq Require Import ZArith Reals Lra Lia Psatz List Bool.
From Lorentz Require Import Spec Time Vectors Number Steps Search Space View Quadratic Reading.
Import ListNotations.
Local Open Scope Z_scope.

(* ---- A piece of a certificate, as it is written: in which place, its ends m 2^e, the rows of its basis.
  What
   is said of it need not be proved: whatever it is read as, the claims are checked. *)
Record end_of_window := Dyadic { mantissa : Z; exponent : Z }.
Record written_piece := WrittenPiece
  { place_in_list : Z; from_end : end_of_window; to_end : end_of_window; basis : list (list Z) }.
Definition twos (bits : Z) : Z := if bits =? 0 then 0 else Z.log2 (Z.land bits (- bits)).
Definition end_at_number (n : numeral) : option end_of_window :=
  option_map (fun i => let k := twos i in Dyadic (Z.shiftr i k) (k - 1074)) (number n).

(* As it is checked: from `begin_at` / E to `end_at` / E. Of `never` the ends mean nothing. *)
Record piece := Piece { begin_at : Z; end_at : Z; r1 : zv; r2 : zv; r3 : zv }.

(* E = 2^f: the ends of all these are multiples of 1 / E. *)
Definition largest_exponent : Z := 2 ^ 14.
Definition fineness (ws : list written_piece) : Z := fold_left (fun f w =>
  Z.max f (Z.min largest_exponent (Z.max (- exponent (from_end w)) (- exponent (to_end w))))) ws 0.
Lemma fineness_nonneg ws : 0 <= fineness ws.
Proof.
  unfold fineness. assert (K : forall f, 0 <= f -> 0 <= fold_left (fun f w =>
    Z.max f (Z.min largest_exponent (Z.max (- exponent (from_end w)) (- exponent (to_end w))))) ws f);
    [|apply K; lia].
  induction ws as [|w ws IH]; cbn [fold_left]; auto. intros f Hf. apply IH. lia.
Qed.

Definition read_end (f : Z) (e : end_of_window) : option Z :=
  if Z.abs (exponent e) <=? largest_exponent then Some (Z.shiftl (mantissa e) (exponent e + f)) else None.
Definition read_row (planar : bool) (r : list Z) : option zv :=
  match planar, r with true, [a; b] => Some (V a b 0) | false, [a; b; c] => Some (V a b c) | _, _ => None end.
Definition read_basis (planar : bool) (rows : list (list Z)) : option (zv * zv * zv) :=
  match planar, all_some (read_row planar) rows with
  | true, Some [a; b] => Some (a, b, V 0 0 1)
  | false, Some [a; b; c] => Some (a, b, c)
  | _, _ => None
  end.
Definition read_piece (planar : bool) (f : Z) (w : written_piece) : option piece :=
  match read_end f (from_end w), read_end f (to_end w), read_basis planar (basis w) with
  | Some b, Some e, Some (r1, r2, r3) => Some (Piece b e r1 r2 r3)
  | _, _, _ => None
  end.
(* Each costs so many steps before it is read. *)
Definition piece_steps : Z := 10.

Section Atom.
  Variables (planar : bool) (f : Z) (y : seen).
  Hypothesis f_nonneg : 0 <= f.
  Let E := 2 ^ f.
  Let Q := sQ y.
  Hypothesis Q_pos : 0 < Q.
  Lemma E_pos : 0 < E.
  Proof. apply Z.pow_pos_nonneg; [reflexivity|exact f_nonneg]. Qed.

  (* ---- 2. and 3.: all obstacles with lo <= s <= hi that the line meets are judged. *)
  Definition check_window (judge : zv -> time -> check) (w : piece) (lo hi : Z) : check :=
    let b n := place origin n (s1 y) (s2 y) (s3 y) in
    require (Z.abs (det (r1 w) (r2 w) (r3 w)) =? 1) Determinant ;;
    search (sv y) (sw y) (sr y - 1) (b (r1 w)) (b (r2 w)) (b (r3 w)) lo hi (fun k W =>
      let D := sD y W in
      if D <=? 0 then done else
      let n := place origin k (r1 w) (r2 w) (r3 w) in
      if planar && negb (vz n =? 0) then done else judge n (Time (sS y W) D Q)).

  Lemma check_window_ok judge w lo hi : passes (check_window judge w lo hi) ->
    forall n, level planar n -> let W := at_cell y n in
    0 < sD y W -> lo <= sS y W <= hi -> passes (judge n (Time (sS y W) (sD y W) Q)).
  Proof.
    intros H n Hn W HD Hs. apply passes_both in H. destruct H as [H1 H2].
    apply passes_require, Z.eqb_eq in H1.
    destruct (unimodular n _ _ _ H1) as [k Ek].
    pose proof (search_ok _ _ _ _ _ _ _ _ _ H2 k) as K. cbv beta zeta in K.
    assert (EW : place (sw y) k (place origin (r1 w) (s1 y) (s2 y) (s3 y)) (place origin (r2 w) (s1 y) (s2 y)
      (s3 y))
      (place origin (r3 w) (s1 y) (s2 y) (s3 y)) = W) by (unfold W, at_cell; rewrite Ek; symmetry;
        apply place_place).
    rewrite EW in K. specialize (K Hs). assert (HH : h2 (sv y) W <= sr y - 1) by (unfold sD in HD; lia).
    specialize (K HH).
    destruct (Z.leb_spec (sD y W) 0); [lia|]. rewrite <- Ek in K.
    assert (planar && negb (vz n =? 0) = false)%bool as Ep.
    { destruct planar; auto. cbn. rewrite Hn by auto. reflexivity. }
    rewrite Ep in K. exact K.
  Qed.

  (* ---- 1. "its windows, in the order in which they are listed, leave no gap": T = s / Q, so e / E < T iff e
     Q < s E. Up to e all has been looked at; and `last`, of how far it is at the end. *)
  Definition check_next (judge : zv -> time -> check) (e : Z) (w : written_piece) (p : piece) : check :=
    require (begin_at p <=? Z.min e (end_at p)) (GapBefore (place_in_list w)) ;;
    check_window judge p (- ((- (begin_at p * Q)) / E)) ((end_at p * Q) / E).
  Fixpoint walk (judge : zv -> time -> check) (last : Z -> check) (e : Z) (ws : list written_piece) (left :
    Z) :
    Z + flaw :=
    match ws with
    | [] => last e left
    | w :: ws => (spend piece_steps ;; let? p := read_piece planar f w else NoVector in
        check_next judge e w p ;; walk judge last (Z.max e (end_at p)) ws) left
    end.
  Lemma walk_ok judge last ws : forall e, passes (walk judge last e ws) -> exists e', passes (last e') /\
    forall s, e * Q < s <= e' * Q -> exists p, begin_at p * Q <= s <= end_at p * Q /\
      passes (check_window judge p (- ((- (begin_at p * Q)) / E)) ((end_at p * Q) / E)).
  Proof.
    induction ws as [|w ws IH]; intros e H.
    - exists e. split; [exact H|]. intros s Hs. exfalso. lia.
    - cbn [walk] in H. apply passes_both in H. destruct H as [_ H].
      destruct (read_piece planar f w) as [p|]; [|apply passes_fail in H; tauto].
      apply passes_both in H. destruct H as [H1 H2]. apply passes_both in H1. destruct H1 as [H0 H1].
      apply passes_require, Z.leb_le in H0. destruct (IH _ H2) as (e' & He & K). exists e'. split;
        [exact He|].
      intros s Hs. destruct (Z_le_gt_dec s (end_at p * Q)).
      + exists p. split; [nia|exact H1].
      + apply K. nia.
  Qed.

  (* "the first begins at or below -r/|v|": just below it. *)
  Definition beginning : Z := - (1 + Z.sqrt ((sr y * (E * E) - 1) / (Q * Q))).
  Lemma beginning_ok s : s * s < sr y -> beginning * Q < s * E.
  Proof.
    pose proof E_pos as EP. intros Hs. unfold beginning. set (X := sr y * (E * E) - 1).
    assert (X0 : s * s * (E * E) <= X) by (unfold X; nia). assert (0 <= X) by nia.
    assert (QQ : 0 < Q * Q) by nia.
    pose proof (Z.div_pos X (Q * Q) ltac:(auto) QQ) as D0. pose proof (Z.sqrt_spec _ D0) as [_ S].
    pose proof (Z.sqrt_nonneg (X / (Q * Q))) as M0. set (m := Z.sqrt (X / (Q * Q))) in *.
    pose proof (Z.mul_succ_div_gt X (Q * Q) QQ) as G. clearbody X.
    assert (B : X < (Z.succ m * Q) * (Z.succ m * Q)).
    { apply Z.lt_le_trans with (1 := G). replace (Z.succ m * Q * (Z.succ m * Q))
        with (Q * Q * (Z.succ m * Z.succ m)) by ring.
      apply Z.mul_le_mono_nonneg_l; lia. }
    destruct (Z_lt_le_dec (- (Z.succ m * Q)) (s * E)) as [L|L]; [lia|exfalso].
    assert (0 <= Z.succ m * Q) by nia. assert (Z.succ m * Q <= - (s * E)) by lia.
    assert (Z.succ m * Q * (Z.succ m * Q) <= - (s * E) * - (s * E)) by (apply Z.mul_le_mono_nonneg; lia). lia.
  Qed.

  (* "the last ends at or above t_X + r/|v|": its end, r/|v| earlier, against `until`. *)
  Definition reaches (e : Z) (until : time) : bool :=
    match order (Time (e * Q) (sr y * (E * E)) (Q * E)) until with Lt => false | _ => true end.
  Lemma reaches_ok e until s D : regular until -> reaches e until = true -> 0 <= D <= sr y ->
    (time_value (Time s D Q) <= time_value until)%R -> s * E <= e * Q.
  Proof.
    pose proof E_pos as EP. intros Hu K HD HV. pose proof (order_ok (Time (e * Q) (sr y * (E * E)) (Q * E))
      until) as O.
    assert (EE : 0 < E * E) by nia.
    assert (Rg : regular (Time (e * Q) (sr y * (E * E)) (Q * E))).
    { split; cbn [td tq]; [apply Z.mul_nonneg_nonneg; lia|apply Z.mul_pos_pos; auto]. }
    specialize (O Rg Hu). unfold reaches in K.
    assert (V : (time_value (Time s D Q) <= time_value (Time (e * Q) (sr y * (E * E)) (Q * E)))%R).
    { destruct (order _ until); try discriminate; simpl in O; lra. }
    clear O K HV Rg. unfold time_value in V; cbn [ts td tq] in V. rewrite sqrt_scale in V by lia.
    rewrite !mult_IZR in V.
    apply le_IZR. rewrite !mult_IZR.
    assert (QP : (0 < IZR Q)%R) by (apply IZR_lt; auto). assert (EP' : (0 < IZR E)%R) by (apply IZR_lt; auto).
    assert (RP : (sqrt (IZR D) <= sqrt (IZR (sr y)))%R) by (apply sqrt_le_1_alt, IZR_le; lia).
    set (q := IZR Q) in *. set (ee := IZR E) in *. set (sd := sqrt (IZR D)) in *.
    set (sq := sqrt (IZR (sr y))) in *.
    replace ((IZR e * q - sq * ee) / (q * ee))%R with ((IZR e * q / ee - sq) / q)%R in V by (field; lra).
    apply Rmult_le_reg_r in V; [|apply Rinv_0_lt_compat; auto].
    assert (W : (IZR s <= IZR e * q / ee)%R) by lra.
    apply Rmult_le_compat_r with (r := ee) in W; [|lra]. unfold Rdiv in W.
    rewrite Rmult_assoc, Rinv_l in W; lra.
  Qed.

  (* ---- All obstacles of the atom that contain x or are entered no later than `until`; any, if there is no
     `until`. *)
  Definition check_windows_in (ws : list written_piece) (until : option time) (gap : flaw)
    (judge : zv -> time -> check) : check :=
    walk judge (fun e => require (match until with None => true | Some t => reaches e t end) gap)
      beginning ws.
  Lemma check_windows_in_ok ws until gap judge : regular until ->
    passes (check_windows_in ws (Some until) gap judge) ->
    forall n, level planar n -> let W := at_cell y n in let s := sS y W in let D := sD y W in
    0 < D -> 0 < s \/ s * s < D -> (time_value (Time s D Q) <= time_value until)%R ->
      passes (judge n (Time s D Q)).
  Proof.
    intros Hu H n Hn W s D HD Hs HV. destruct (walk_ok _ _ _ _ H) as (e & H2 & K). apply passes_require in H2.
    pose proof E_pos as EP.
    assert (HDR : D <= sr y) by (unfold D, sD; pose proof (h2_nonneg (sv y) W); lia).
    destruct (K (s * E)) as (p & Hb & Hp).
    { split.
      - destruct Hs as [Hs|Hs]; [|apply beginning_ok; lia].
        assert (beginning * Q < 0 * E) by (apply beginning_ok; lia).
        assert (0 < s * E) by (apply Z.mul_pos_pos; auto). lia.
      - apply (reaches_ok e until s D); auto. lia. }
    apply (check_window_ok _ _ _ _ Hp); auto. fold W. fold s. split.
    - apply Z.opp_le_mono. rewrite Z.opp_involutive. apply Z.div_le_lower_bound; auto. lia.
    - apply Z.div_le_lower_bound; auto. lia.
  Qed.

  (* ---- never: "b_1 is parallel to v, so all obstacles of a row have the same h". One of each row has 0 <= s
     <= |s_1|. *)
  Definition check_piece_of_row (w : piece) (met : zv -> flaw) : check :=
    let b1 := place origin (r1 w) (s1 y) (s2 y) (s3 y) in let s1 := sS y b1 in let c := cross (sv y) b1 in
    require ((vx c =? 0) && (vy c =? 0) && (vz c =? 0) && negb (s1 =? 0) &&
      negb (planar && negb (vz (r1 w) =? 0))) NotAlong ;;
    check_window (fun n _ => fail (met n)) w 0 (Z.abs s1).
  Lemma check_piece_of_row_ok w met : passes (check_piece_of_row w met) -> forall n, level planar n ->
    ~ 0 < sD y (at_cell y n).
  Proof.
    intros H n Hn Dp. apply passes_both in H. destruct H as [H Hw]. apply passes_require in H.
    rewrite !Bool.andb_true_iff, !Bool.negb_true_iff, !Z.eqb_eq, Z.eqb_neq in H.
    destruct H as [[[[Hx Hy] Hz] Hs1] Hpl].
    set (b1 := place origin (r1 w) (s1 y) (s2 y) (s3 y)) in *. set (step := sS y b1) in *.
    set (W := at_cell y n) in *.
    assert (B0 : cross (sv y) b1 = V 0 0 0) by (apply zv_eq; auto).
    assert (exists m, 0 <= sS y W + m * step <= Z.abs step) as [m Hm].
    { set (s := sS y W). destruct (Z_lt_le_dec 0 step) as [P|N].
      - exists (- (s / step)). pose proof (Z.mod_pos_bound s step P). pose proof (Z.div_mod s step Hs1). lia.
      - exists (s / - step). assert (P : 0 < - step) by lia. pose proof (Z.mod_pos_bound s (- step) P).
        pose proof (Z.div_mod s (- step) ltac:(lia)). lia. }
    assert (EW : at_cell y (add n m (r1 w)) = add W m b1) by apply place_step.
    assert (Sm : sS y (add W m b1) = sS y W + m * step) by apply dot_add.
    assert (Dm : sD y (add W m b1) = sD y W).
    { unfold sD. rewrite h2_add, B0, lagrange. unfold dot; cbn [vx vy vz]. ring. }
    pose proof (check_window_ok _ _ _ _ Hw (add n m (r1 w))) as K. cbv zeta in K. rewrite EW, Sm, Dm in K.
    apply (passes_fail (met (add n m (r1 w)))), K; auto.
    intros Ep. cbn [add vz]. rewrite (Hn Ep). rewrite Ep in Hpl. cbn in Hpl.
    apply Bool.negb_false_iff, Z.eqb_eq in Hpl.
    rewrite Hpl. ring.
  Qed.
End Atom.

(* With these windows; with this row. *)
Definition check_windows (planar : bool) (y : seen) (ws : list written_piece) : option time -> flaw ->
  (zv -> time -> check) -> check := check_windows_in planar (fineness ws) y ws.
Lemma check_windows_ok planar y ws until gap judge : 0 < sQ y -> regular until ->
  passes (check_windows planar y ws (Some until) gap judge) ->
  forall n, level planar n -> let W := at_cell y n in let s := sS y W in let D := sD y W in
  0 < D -> 0 < s \/ s * s < D -> (time_value (Time s D (sQ y)) <= time_value until)%R ->
    passes (judge n (Time s D (sQ y))).
Proof. intros HQ. apply check_windows_in_ok; [apply fineness_nonneg|exact HQ]. Qed.

Definition check_row (planar : bool) (y : seen) (w : written_piece) (met : zv -> flaw) : check :=
  spend piece_steps ;; let? b := read_basis planar (basis w) else NoVector in
  let '(r1, r2, r3) := b in check_piece_of_row planar y (Piece 0 0 r1 r2 r3) met.
Lemma check_row_ok planar y w met : passes (check_row planar y w met) ->
  forall n, level planar n -> ~ 0 < sD y (at_cell y n).
Proof.
  intros H. apply passes_both in H. destruct H as [_ H].
  destruct (read_basis planar (basis w)) as [[[r1 r2] r3]|]; [|apply passes_fail in H; tauto].
  exact (check_piece_of_row_ok planar 0 y (Z.le_refl 0) _ _ H).
Qed.
